#pragma once

namespace perifrac {

/// A beam of length L and height h in plane strain, clamped at one end, under a load across it that
/// comes on suddenly.
struct CantileverProblem {
  double youngs_modulus;  ///< [Pa]
  double poisson_ratio;
  double density;  ///< [kg/m^3]
  double length;   ///< [m]
  double height;   ///< [m]
  double load;     ///< force per volume [N/m^3]
};

/// Timoshenko's beam, with E/(1 - nu^2) for E in plane strain: static deflection, and the first
/// natural frequency after Huang, J. Appl. Mech. 28 (1961).
class CantileverSolution {
 public:
  explicit CantileverSolution(const CantileverProblem& problem);

  double angular_frequency() const { return angular_frequency_; }  ///< of the first mode [1/s]
  double period() const;                                           ///< [s]
  double static_deflection() const { return static_deflection_; }  ///< of the tip [m]

  /// Deflection of the tip [m] by the first mode alone, which makes 1.3 % more than the static
  /// deflection; the others make the rest.
  double deflection(double t) const;

 private:
  double angular_frequency_;
  double static_deflection_;
};

}  // namespace perifrac
