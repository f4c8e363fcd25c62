#pragma once

#include <cmath>

namespace perifrac {

/// A barotropic fluid: linear, p = K (rho / rho_0 - 1), or Tait,
/// p = K / gamma [(rho / rho_0)^gamma - 1].
struct FluidProperties {
  double density;              ///< rho_0, at zero pressure [kg/m^3]
  double bulk_modulus;         ///< K, at zero pressure [Pa]
  double viscosity;            ///< dynamic [Pa s]
  double tait_exponent = 0.0;  ///< gamma > 1; 0: linear

  double pressure(double rho) const {
    const double ratio = rho / density;
    if (tait_exponent == 0.0) return bulk_modulus * (ratio - 1.0);
    return bulk_modulus / tait_exponent * std::expm1(tait_exponent * std::log(ratio));
  }
  /// Work that compressed it from zero pressure, the integral of p / rho^2 over density [J/kg].
  double elastic_energy(double rho) const {
    const double excess = rho / density - 1.0, gained = excess / (1.0 + excess);
    const double of_unit = bulk_modulus / density, power = tait_exponent - 1.0;
    if (tait_exponent == 0.0) return of_unit * (std::log1p(excess) - gained);
    const double raised = std::expm1(power * std::log1p(excess)) / power;
    return of_unit / tait_exponent * (raised - gained);
  }
  double density_at(double p) const {
    if (tait_exponent == 0.0) return density * (1.0 + p / bulk_modulus);
    return density * std::exp(std::log1p(tait_exponent * p / bulk_modulus) / tait_exponent);
  }
  /// Density where fluid at rest that has the density rho would lie deeper by a `potential` g.x
  /// [m^2/s^2].
  double density_below(double rho, double potential) const {
    const double growth = density * potential / bulk_modulus;
    if (tait_exponent == 0.0) return rho * std::exp(growth);
    const double power = tait_exponent - 1.0;
    return density * std::pow(std::pow(rho / density, power) + power * growth, 1.0 / power);
  }
  /// [m/s]
  double sound_speed(double rho) const {
    const double ratio = tait_exponent == 0.0 ? 1.0 : std::pow(rho / density, tait_exponent - 1.0);
    return std::sqrt(bulk_modulus / density * ratio);
  }
  double sound_speed() const { return sound_speed(density); }
};

/// How the fluid is discretised and steadied.
struct FluidScheme {
  double spacing;  ///< of the points at the start [m]
  double horizon;  ///< [m]
  double
      artificial_viscosity;  ///< least kinematic viscosity between fluid points, over c_0 spacing
  double wall_viscosity = 0.0;  ///< the same between fluid and walls that do not slip
  double density_diffusion;     ///< diffusivity of density, over c_0 spacing
  double shifting = 0.0;        ///< of points away from crowds (particle_shifting.hpp)
  double courant;               ///< step over spacing / (c + |v|)
  double merge_below = 0.0;     ///< mass under which points are merged, over that of a new one
};

}  // namespace perifrac
