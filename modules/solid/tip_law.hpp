#pragma once

#include <cmath>

namespace perifrac {

/// Opening of a crack close behind its tip, where a viscous fluid follows the tip without lag:
///   w^3 = (K' sqrt(s) / E')^3 + 2 3^(5/2) (mu' V / E') s^2,
/// the toughness asymptote and the viscous one joined (Garagash, Detournay & Adachi 2011 give
/// both).
struct TipLaw {
  double plane_strain_modulus;  ///< E' = E / (1 - nu^2) [Pa]
  double fracture_energy;       ///< Gc [J/m^2]

  double toughness() const { return std::sqrt(plane_strain_modulus * fracture_energy); }  ///< K_IC

  /// At s behind the tip [m], for a viscosity [Pa s] and a speed of the tip [m/s]; the part of
  /// viscosity is taken at `viscous_s`, for a tip on a lattice is not in one place for both.
  double opening(double s, double viscous_s, double viscosity, double speed) const {
    const double dry = std::sqrt(32.0 / M_PI) * toughness() * std::sqrt(s) / plane_strain_modulus;
    const double wet = 2.0 * std::pow(3.0, 2.5) * 12.0 * viscosity * speed / plane_strain_modulus *
                       viscous_s * viscous_s;
    return std::cbrt(dry * dry * dry + wet);
  }
};

}  // namespace perifrac
