#pragma once

namespace perifrac {

/// A plane-strain hydraulic fracture of two wings in an infinite impermeable body, without fluid
/// lag: the self-similar solution for any toughness (Spence and Sharp 1985; Adachi and Detournay
/// 2002), interpolated in a table computed by tests/references/kgd.py.
class KgdSolution {
 public:
  struct Problem {
    double plane_strain_modulus;  ///< E' = E / (1 - nu^2) [Pa]
    double fracture_energy;       ///< Gc [J/m^2]
    double viscosity;             ///< [Pa s]
    double rate;                  ///< into both wings [m^2/s]
  };

  /// Throws std::domain_error for a toughness beyond the table.
  explicit KgdSolution(const Problem& problem);

  /// K_m = K' / (mu' Q E'^3)^(1/4): below 0.7 viscosity decides, above 4.8 toughness.
  double dimensionless_toughness() const { return toughness_; }

  double length(double t) const;    ///< of one wing at t [s]; [m]
  double opening(double t) const;   ///< at the inlet [m]
  double pressure(double t) const;  ///< there, less the stress across the crack [Pa]

 private:
  Problem problem_;
  double toughness_;
  double length_factor_, opening_factor_, pressure_factor_;
};

}  // namespace perifrac
