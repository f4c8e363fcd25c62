#pragma once

#include <span>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/body/body.hpp"
#include "core/config/section.hpp"
#include "core/geometry/gaussian_influence.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/fluid/points/fluid_points.hpp"
#include "modules/fluid/points/fluid_properties.hpp"

namespace perifrac {

/// Where cracks open into the fluid: what flows in there leaves the points within a horizon, and is
/// the cracks' from then on. The cracks say how much they have taken since the start, one window
/// late in one pass; what is not yet given is given, evenly over the next window.
///
/// Points give in proportion to omega m, at their own velocity and volume, so that their pressure
/// falls; what comes back raises it. The momentum goes to the body's points beside the mouth.
template <int D>
class FluidMouths {
 public:
  FluidMouths(const std::vector<Vector<D>>& places, const Body<D>& body, double horizon);

  const PointSet& points() const { return point_set_; }
  /// By how much the pressure at each mouth falls at once with what is taken there, -dp/dm
  /// [Pa/kg]; 0 where there is no fluid.
  std::span<double> stiffness(const FluidPoints<D>& fluid, const FluidProperties& properties);
  /// The mean pressure at each mouth [Pa]; 0 where there is no fluid.
  std::span<double> pressure(const FluidPoints<D>& fluid, const FluidProperties& properties);
  /// By how much the pressure has fallen for good once sound has spread what was taken over all the
  /// fluid, 1 / sum(V / c^2) [Pa/kg], at each mouth.
  std::span<double> volume_stiffness(const FluidPoints<D>& fluid,
                                     const FluidProperties& properties);
  /// The time in which it does so near each mouth: that of sound over a horizon [s].
  std::span<double> relaxation(const FluidProperties& properties);
  /// What each mouth has given since the start [kg].
  std::span<double> given_by_mouth() { return given_; }
  /// In-port: what cracks have taken in at each mouth since the start [kg].
  std::span<double> taken() { return taken_; }

  void begin_window(double length);  ///< [s]
  /// Gives the part of a step of what is owed, but not more than half of what there is. Needs
  /// volumes; `impulse` on the body's points, D blocks [N s], grows.
  void give(FluidPoints<D>& fluid, double length, std::vector<double>& impulse);

  double given() const;  ///< since the start [kg]
  void visit_state(StateVisitor& visitor);

 private:
  double find_weights(const FluidPoints<D>& fluid, std::size_t mouth);

  std::array<std::vector<double>, D> place_;
  PointSet point_set_;
  std::vector<std::vector<Index>> beside_;  ///< by mouth: the body's points that take the momentum
  double horizon_;
  GaussianInfluence influence_;
  double left_ = 0.0;  ///< of the window [s]

  std::vector<double> pressure_, stiffness_, volume_stiffness_, relaxation_, taken_;
  std::vector<double> given_;                      ///< state, by mouth [kg]
  std::vector<double> given_lost_;                 ///< state: what rounding cut off it [kg]
  std::vector<std::pair<Index, double>> weights_;  // workspace: omega m of the points at a mouth
};

/// Where the inlets of the scene's crack_fluid that hold the fluid's pressure lie; none without.
template <int D>
std::vector<Vector<D>> read_mouths(const Section& scene, const Body<D>* body);

}  // namespace perifrac
