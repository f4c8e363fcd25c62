#pragma once

#include <string>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"
#include "core/time/schedule.hpp"

namespace perifrac {

/// A wall that does not deform: it rests, moves as prescribed, or is a piston, which slides along
/// the force on it and has a mass.
template <int D>
struct RigidWall {
  enum class Motion { fixed, moving, piston };

  std::string name;
  Motion motion = Motion::fixed;
  Vector<D> value{};  ///< velocity [m/s], or force on a piston [N, N/m in 2D], times the schedule
  Schedule schedule{};
  double mass = 0.0;  ///< of a piston [kg, kg/m in 2D]

  // State.
  Vector<D> displacement{};  ///< [m]
  Vector<D> velocity{};      ///< [m/s]

  void drift(double length) { displacement += length * velocity; }

  /// The velocity for a step about time t, before anything is evaluated.
  void follow(double t) {
    if (motion != Motion::moving) return;
    velocity = value * schedule.factor(t);
  }

  /// `force` is the fluid's.
  void kick(double t, double length, const Vector<D>& force, const Vector<D>& gravity) {
    if (motion != Motion::piston) return;
    const double along = dot(value * schedule.factor(t) + force + mass * gravity, value);
    velocity += length * along / (mass * squared_norm(value)) * value;
  }
};

}  // namespace perifrac
