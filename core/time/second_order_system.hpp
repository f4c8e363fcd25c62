#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace perifrac {

/// Equations of motion m d2y/dt2 = f(t, y), one mass an unknown, with stiffness K = -df/dy
/// symmetric and without negative eigenvalues.
class SecondOrderSystem {
 public:
  virtual ~SecondOrderSystem() = default;

  /// What y is, for messages: the name that visit_state gives to it.
  virtual std::string_view name() const = 0;

  /// Where an unknown lies, for messages.
  virtual std::string place(std::size_t unknown) const {
    return "entry " + std::to_string(unknown);
  }

  /// One an unknown, positive.
  virtual std::span<const double> mass() const = 0;

  /// force = f(t, y). Called once at each time that is reached, in order, so that a system may
  /// keep accounts of what is done on it.
  virtual void force(double t, std::span<const double> y, std::span<double> force) = 0;

  /// product = K v, without forming K; K may be one of reference that the present stiffness exceeds
  /// by stiffness_growth() at most.
  virtual void stiffness_times(std::span<const double> v, std::span<double> product) = 0;

  /// Rises whenever K becomes another matrix.
  virtual std::uint64_t stiffness_version() const = 0;

  /// A bound, at least 1, of how much stiffer than K the system is now.
  virtual double stiffness_growth() const { return 1.0; }

  /// Impulses beside f at the two ends of a step [s], where velocities are those of that time.
  virtual void begin_step([[maybe_unused]] double step,
                          [[maybe_unused]] std::span<double> velocity) {}
  virtual void end_step([[maybe_unused]] double step, [[maybe_unused]] std::span<double> velocity) {
  }

  /// Called after every step, at the y of the last force: true where the system became another one
  /// there, whose force is to be found anew.
  virtual bool changes() { return false; }
};

}  // namespace perifrac
