#pragma once

#include <vector>

namespace perifrac {

/// Mandel's problem: a poroelastic slab of half width `a` and half height `b` in plane strain,
/// pressed between two rigid, frictionless, sealed plates and drained at its sides.
struct MandelProblem {
  double lame_lambda;       ///< [Pa]
  double shear_modulus;     ///< [Pa]
  double biot_coefficient;  ///< alpha
  double storage;           ///< 1/M, at constant strain [1/Pa]
  double mobility;          ///< permeability / viscosity [m^2/(Pa s)]
  double half_width;        ///< a [m]
  double half_height;       ///< b [m]
  double force;             ///< on half the width, F [N/m]
};

/// Its analytic solution, for compressible constituents: Cheng and Detournay, Int. J. Numer. Anal.
/// Meth. Geomech. 12 (1988); paper Eqs 36-41, with c as in docs/theory.
class MandelSolution {
 public:
  explicit MandelSolution(const MandelProblem& problem);

  double initial_pressure() const { return initial_pressure_; }        ///< p0 [Pa]
  double consolidation_coefficient() const { return consolidation_; }  ///< c [m^2/s]
  double dimensionless_time(double t) const;                           ///< c t / a^2
  double undrained_poisson_ratio() const { return undrained_poisson_ratio_; }
  double skempton_coefficient() const { return skempton_; }

  /// Pore pressure [Pa] at x from the middle, t > 0 [s]; p0 at t <= 0.
  double pressure(double x, double t) const;
  /// Vertical displacement of the upper plate [m], negative downwards; undrained at t <= 0.
  double plate_displacement(double t) const;
  /// The largest pressure that the point x ever has [Pa].
  double peak_pressure(double x) const;

 private:
  MandelProblem problem_;
  double poisson_ratio_;
  double undrained_poisson_ratio_;
  double skempton_;
  double consolidation_;
  double initial_pressure_;
  std::vector<double> root_;  ///< of tan(b) = (1 - nu) / (nu_u - nu) b
};

}  // namespace perifrac
