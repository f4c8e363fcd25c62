#pragma once

#include <span>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// What an elastic operator tells beyond a linear one: another stiffness at every strain, and what
/// its points remember of those before.
class NonlinearResponse {
 public:
  virtual ~NonlinearResponse() = default;

  /// Takes the stiffness at the displacements u [m].
  virtual void linearise(std::span<const double> u) = 0;
  /// That times v; symmetric [N].
  virtual void apply_tangent(std::span<const double> v, std::span<double> force) = 0;

  /// How many numbers a point remembers; 0: the law has no memory.
  virtual int memory_size() const = 0;
  /// They themselves, block by block of points.
  virtual std::span<double> memory() = 0;
  /// As if nothing had happened yet.
  virtual void forget() = 0;
  /// The body has been `seconds` on its way to u, and is there: takes its memory along.
  virtual void follow(std::span<const double> u, double seconds) = 0;
  /// What that turned into heat so far [J, per metre in 2D].
  virtual double heat() const = 0;
  virtual void visit_state(StateVisitor& visitor) = 0;
};

/// The response of a material that remembers; nullptr: it does not.
template <class Material>
NonlinearResponse* with_memory(Material& rock) {
  NonlinearResponse* const nonlinear = rock.nonlinear();
  return nonlinear != nullptr && nonlinear->memory_size() > 0 ? nonlinear : nullptr;
}

}  // namespace perifrac
