#pragma once

namespace perifrac {

/// What follows a tip through a crack, without lag.
struct TipFluid {
  double viscosity;             ///< [Pa s]
  double leak_off_coefficient;  ///< Carter's C_L of one side [m/s^0.5]
};

/// Openings end to go as sqrt(s) where the crack's other end makes itself felt: as that of a crack
/// of half length l under uniform pressure, sqrt(s (1 - s / 2l)), whose K_I at fixed volume goes as
/// l^-1.5. The s of an endless crack that is as open [m].
inline double within_crack(double s, double inverse_half_length) {
  return s * (1.0 - 0.5 * s * inverse_half_length);
}

/// Opening of a crack close behind its tip: the asymptotes of toughness, of viscosity where fluid
/// stays in the crack and of viscosity where it leaks off,
///   w = K' s^(1/2) / E',
///   w^3 = 2 3^(5/2) mu' V s^2 / E',
///   w = 2.534 (4 mu'^2 V C'^2 / E'^2)^(1/8) s^(5/8),
/// joined as by Dontsov & Peirce (2015), whose zeroth order is exact at each (Garagash, Detournay &
/// Adachi 2011 give the asymptotes).
struct TipLaw {
  double plane_strain_modulus;  ///< E' = E / (1 - nu^2) [Pa]
  double fracture_energy;       ///< Gc [J/m^2]

  double toughness() const;  ///< K_IC [Pa m^0.5]

  /// At s behind the tip [m], for a speed of the tip [m/s]; the part of viscosity is taken at
  /// `viscous_s`, for a tip on a lattice is not in one place for both.
  double opening(double s, double viscous_s, const TipFluid& fluid, double speed) const;
};

}  // namespace perifrac
