#pragma once

namespace perifrac {

/// A viscous fluid between two plates at rest, under a force along them from t = 0 on.
struct PoiseuilleProblem {
  double gap;           ///< between the plates [m]
  double viscosity;     ///< kinematic [m^2/s]
  double acceleration;  ///< force over mass [m/s^2]
};

/// Poiseuille's flow from rest: the parabola less what decays, a Fourier series.
class PoiseuilleSolution {
 public:
  explicit PoiseuilleSolution(const PoiseuilleProblem& problem) : problem_(problem) {}

  double time_scale() const { return problem_.gap * problem_.gap / problem_.viscosity; }  ///< [s]
  /// Largest velocity of the steady flow [m/s].
  double peak() const { return problem_.acceleration * time_scale() / 8.0; }
  /// Velocity [m/s] at height y above the lower plate.
  double velocity(double y, double t) const;

 private:
  PoiseuilleProblem problem_;
};

}  // namespace perifrac
