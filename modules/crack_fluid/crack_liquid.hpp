#pragma once

#include <algorithm>
#include <cmath>

namespace perifrac {

/// The fluid in a crack, and what a facet holds at its one unknown v [Pa]: a full facet is under
/// the pressure v; below the vapour pressure p_v it is filled to 1 + (v - p_v) / K_f and under p_v.
/// One unknown for both makes mass an increasing function of it, through a front that passes.
struct CrackLiquid {
  double density;                ///< at zero pressure [kg/m^3]
  double viscosity;              ///< [Pa s]
  double bulk_modulus;           ///< [Pa]
  double vapour_pressure = 0.0;  ///< [Pa]
  /// Least aperture that fluid is stored in and flows through [m].
  double residual_aperture = 2e-6;

  bool is_full(double v) const { return v >= vapour_pressure; }
  double pressure(double v) const { return std::max(v, vapour_pressure); }
  double fill(double v) const { return 1.0 + std::min(v - vapour_pressure, 0.0) / bulk_modulus; }
  double empty() const { return vapour_pressure - bulk_modulus; }  ///< v of a dry facet

  /// v after its change, stopped at the edge between full and not, and where a facet is empty.
  double moved(double v, double change) const {
    const double goal = v + change;
    if (is_full(v) && !is_full(goal)) return vapour_pressure - 1e-13 * bulk_modulus;
    if (!is_full(v) && is_full(goal)) return vapour_pressure;
    return std::max(goal, empty());
  }

  /// Of what a facet of this volume holds at v [kg].
  double mass(double volume, double v) const { return density_at(pressure(v)) * volume * fill(v); }
  double density_at(double p) const { return density * (1.0 + p / bulk_modulus); }
  /// h = int dp / rho, from 0 on [J/kg].
  double enthalpy(double p) const { return bulk_modulus / density * std::log1p(p / bulk_modulus); }
  double internal_energy(double p) const { return enthalpy(p) - p / density_at(p); }  ///< [J/kg]
};

}  // namespace perifrac
