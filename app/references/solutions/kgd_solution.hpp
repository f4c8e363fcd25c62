#pragma once

namespace perifrac {

/// What drives a plane-strain hydraulic fracture of two wings, and what resists.
struct KgdProblem {
  double plane_strain_modulus;  ///< E' = E / (1 - nu^2) [Pa]
  double fracture_energy;       ///< Gc [J/m^2]
  double viscosity;             ///< [Pa s]
  double rate;                  ///< into both wings [m^2/s]

  /// K' = 4 (2/pi)^(1/2) K_IC [Pa m^0.5].
  double toughness() const;
  /// K_m = K' / (mu' Q E'^3)^(1/4), mu' = 12 mu: below 0.7 viscosity decides, above 4.8 toughness.
  double dimensionless_toughness() const;
};

/// Half the crack; opening, and pressure less the closing stress, at its inlet.
struct CrackSize {
  double length;    ///< [m]
  double opening;   ///< [m]
  double pressure;  ///< [Pa]
};

/// Where toughness alone counts and nothing leaks: one pressure in an elliptic crack,
///   l^(3/2) = E' Q t / (2 pi^(1/2) K_IC),  p = K_IC / (pi l)^(1/2),  w = 4 p l / E'.
CrackSize toughness_corner(const KgdProblem& driven, double t);

/// Such a fracture in an infinite impermeable body, without fluid lag: the self-similar solution
/// for any toughness (Spence and Sharp 1985; Adachi and Detournay 2002), interpolated in a table
/// computed by tests/references/kgd.py; where there is no viscosity, that of toughness alone.
class KgdSolution {
 public:
  /// Of the table, dimensionless.
  static constexpr double least_toughness = 0.15, most_toughness = 6.0;

  /// Throws std::domain_error for a toughness beyond the table, unless it has no end.
  explicit KgdSolution(const KgdProblem& problem);

  double length(double t) const;    ///< of one wing at t [s]; [m]
  double opening(double t) const;   ///< at the inlet [m]
  double pressure(double t) const;  ///< there, less the stress across the crack [Pa]

 private:
  KgdProblem problem_;
  bool is_inviscid_;
  double length_factor_ = 0.0, opening_factor_ = 0.0, pressure_factor_ = 0.0;
};

}  // namespace perifrac
