#pragma once

#include <span>

namespace perifrac {

/// What breaks a body that moves, and what that adds to its forces.
class BodyFracture {
 public:
  virtual ~BodyFracture() = default;
  /// Takes its force at time t [s] and displacements u from the inner force on every unknown [N].
  /// Called once at each time that is reached, and again where something jumped.
  virtual void add([[maybe_unused]] double t, [[maybe_unused]] std::span<const double> u,
                   [[maybe_unused]] std::span<double> inner) {}
  /// Impulses at the ends of a step [s], on the velocity of what has a mass.
  virtual void begin_step([[maybe_unused]] double step,
                          [[maybe_unused]] std::span<double> velocity) {}
  virtual void end_step([[maybe_unused]] double step, [[maybe_unused]] std::span<double> velocity) {
  }
  /// At the end of a step: breaks what is to break at u; whether it did.
  virtual bool breaks([[maybe_unused]] std::span<const double> u) { return false; }
  /// A bound, at least 1, of how much stiffer than it was at first the body is.
  virtual double stiffness_growth() const = 0;
  /// The state was replaced: takes the body to what it is in that.
  virtual void follow_state() = 0;
};

}  // namespace perifrac
