#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "core/time/second_order_system.hpp"

namespace perifrac {

/// What the equations of motion carry from step to step.
struct Motion {
  std::vector<double> position;  ///< y
  std::vector<double> velocity;
  std::vector<double> acceleration;  ///< at y, damping apart: each step evaluates one force
  double damped_energy = 0.0;        ///< taken out by damping so far
};

/// Velocity Verlet, kick - drift - kick, for m y'' = f(t, y) - damping m y'. Second order,
/// time-reversible without damping. Damping acts before and after each step as the exact factor
/// exp(-damping h / 2) on velocities, so that the stable limit stays 2 / largest angular frequency
/// however strong it is: step and factors have determinant exp(-damping h) and trace
/// (1 - (omega h)^2 / 2) (1 + exp(-damping h)).
///
/// With a steady step, kinetic energy - h^2/8 sum m a^2 changes by exactly the trapezoidal work of
/// f, less what is damped: the energy that the scheme keeps.
class VelocityVerlet {
 public:
  /// The system must outlive the integrator. damping >= 0 [1/s]; a step is at most safety (0 to 1)
  /// times the stable limit.
  explicit VelocityVerlet(SecondOrderSystem& system, double damping = 0.0, double safety = 0.9);

  /// Finds the acceleration at t [s] anew: at the start, and where f has jumped.
  void evaluate(double t, Motion& motion);

  /// From `begin` to `end` [s] in equal steps, as long as the stiffness is the same. Throws
  /// NumericalError.
  void advance(double begin, double end, Motion& motion);

  /// 2 / largest angular frequency [s] of the present stiffness; infinity where there is none.
  /// Throws NumericalError.
  double stable_step(double t);
  /// The longest step that is taken [s].
  double longest_step(double t) { return safety_ * stable_step(t); }

  /// In this process.
  std::int64_t steps() const { return steps_; }

 private:
  void step(double t, double length, Motion& motion);
  void damp(double factor, Motion& motion);

  SecondOrderSystem& system_;
  double damping_;
  double safety_;
  double stable_step_ = 0.0;
  std::optional<std::uint64_t> limit_version_;  ///< the stiffness that stable_step_ belongs to
  std::int64_t steps_ = 0;
  std::vector<double> block_sums_;  // workspace
};

/// sum 1/2 m v^2.
double kinetic_energy(std::span<const double> mass, std::span<const double> velocity);

}  // namespace perifrac
