#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "core/state/compensated_sum.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/fluid_properties.hpp"

namespace perifrac {

/// The books of a free fluid's energy [J, J/m in 2D]: what its points hold, what came in since the
/// start and what friction turned into heat. What is over is made by numerical measures, such as
/// volume that points beside walls gain or lose under pressure.
template <int D>
class FluidEnergy {
 public:
  /// Both must stay. Heights are above the centre of `points`, what there is at the start.
  FluidEnergy(const FluidProperties& fluid, const Vector<D>& gravity, const FluidPoints<D>& points);

  /// Of motion, compression and height, at the end of a step.
  double stored(const FluidPoints<D>& points) const;
  /// Work of walls, and what came with mass; less what left.
  double gained() const { return gained_.value(); }
  double heat() const { return heat_.value(); }
  bool is_finite() const { return std::isfinite(gained()) && std::isfinite(heat()); }
  /// What is there beyond what should be.
  double made(const FluidPoints<D>& points) const {
    return stored(points) - at_start_ - gained() + heat();
  }

  void gain(double energy) { gained_.add(energy); }
  /// Friction is found anew in this step, every eighth: it costs a tenth and more of one.
  bool begins_friction() { return steps_++ % 8 == 0; }
  /// Its power [W]: linear since it was last found.
  void set_friction(double power) {
    heat_.add(0.5 * (power - friction_) * since_);
    friction_ = power;
    since_ = 0.0;
  }
  /// Of a step of `length` [s]: by friction and `other` heat [J].
  void heat_up(double length, double other) {
    heat_.add(length * friction_ + other);
    since_ += length;
  }

  /// Masses are about to change, at the velocities and volumes that there are.
  void remember_masses(const FluidPoints<D>& points) { mass_ = points.mass; }
  /// They have: energy came with them.
  void gain_with_mass(const FluidPoints<D>& points);
  /// Points from number `first` on are new.
  void gain_points(const FluidPoints<D>& points, Index first) { gain(of_points(points, first)); }
  /// What `change` does to the points comes from outside.
  template <class Change>
  void gain_by(const FluidPoints<D>& points, Change&& change) {
    const double before = of_points(points, 0);
    change();
    gain(of_points(points, 0) - before);
  }

  /// A step of `length` [s] leaves densities half a step behind velocities. `power`, the sum of
  /// p V div v [W], is what they lose until there.
  void set_lag(double power, double length) { lag_ = -0.5 * length * power; }

  void visit_state(StateVisitor& visitor);

 private:
  double of_point(const FluidPoints<D>& points, Index i, double mass, double density) const;
  double of_points(const FluidPoints<D>& points, Index first) const;

  const FluidProperties& fluid_;
  const Vector<D>& gravity_;
  Vector<D> centre_{};  ///< of mass, at the start [m]
  double at_start_ = 0.0;
  CompensatedSum gained_, heat_;
  std::int64_t steps_ = 0;
  double friction_ = 0.0;  ///< [W]
  double since_ = 0.0;     ///< that was found [s]
  double lag_ = 0.0;
  std::vector<double> mass_;  // workspace
};

}  // namespace perifrac
