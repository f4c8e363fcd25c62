#pragma once

#include <vector>

namespace perifrac {

/// Cryer's problem: a poroelastic ball under a pressure that comes on suddenly all round, drained
/// at its surface.
struct CryerProblem {
  double bulk_modulus;   ///< drained [Pa]
  double shear_modulus;  ///< [Pa]
  double biot_coefficient;
  double storage;   ///< at constant strain [1/Pa]
  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]
  double radius;    ///< a [m]
  double load;      ///< P, presses on the surface [Pa]
};

/// Its solution for compressible constituents; Cryer, Q. J. Mech. Appl. Math. 16 (1963), is the
/// case of incompressible ones.
///
/// Displacement is radial, so equilibrium makes (K + 4/3 mu) theta - alpha p uniform; the traction
/// on the surface ties it to the mean pressure. What is left is
///     d/dt (p + beta mean(p)) = c Laplace(p),  p = 0 at r = a,
/// with beta = 4 mu alpha^2 / (3 K (K + 4/3 mu) (S + alpha^2 / (K + 4/3 mu))). Its modes are
/// sin(x r/a) / (x r/a) - sin(x) / x, and (1 + beta) x^2 sin x = 3 beta (sin x - x cos x).
class CryerSolution {
 public:
  explicit CryerSolution(const CryerProblem& problem);

  double initial_pressure() const { return initial_pressure_; }  ///< p0, undrained [Pa]
  double time_scale() const;                                     ///< a^2 / c [s]

  /// Pore pressure [Pa] at r from the middle; p0 at t <= 0.
  double pressure(double r, double t) const;
  /// Radial displacement [m] of the surface, negative inwards; undrained at t <= 0.
  double surface_displacement(double t) const;
  /// The largest pressure that the middle ever has [Pa], and when [s].
  struct Peak {
    double pressure;
    double time;
  };
  Peak peak() const;

 private:
  /// A mode decays as exp(-x^2 c t / a^2).
  struct Mode {
    double x;
    double amplitude;  ///< over p0
    double mean;       ///< over the ball, of the mode without its amplitude
  };
  double mean_pressure(double t) const;

  CryerProblem problem_;
  double consolidation_;
  double initial_pressure_;
  std::vector<Mode> modes_;
};

}  // namespace perifrac
