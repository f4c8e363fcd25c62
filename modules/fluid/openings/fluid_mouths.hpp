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
#include "modules/fluid/points/running_total.hpp"

namespace perifrac {

/// Where cracks open into the fluid: what flows in there leaves the points within a horizon, and is
/// the cracks' from then on. The cracks say how much they took in over a window, one window late in
/// one pass; until it is given it is owed.
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
  /// The mean pressure at each mouth, and with it what it fell at once by what was given in the
  /// window before its last step: cracks take that off for all that they take [Pa]. 0 where there
  /// is no fluid. So a flow that is steady over many steps meets the fluid's own pressure, and in
  /// windows of one step cracks meet the pressure that is there once they have taken: an exchange
  /// that lags by a step feeds the swinging of rock and water against each other.
  std::span<double> pressure(const FluidPoints<D>& fluid, const FluidProperties& properties);
  /// In-port: what cracks took in at each mouth over a window [kg].
  std::span<double> intake() { return intake_; }

  void begin_window(double length);  ///< [s]
  /// Gives the part of a step, and what is owed, but not more than half of what there is. Needs
  /// volumes; `impulse` on the body's points, D blocks [N s], grows.
  void give(FluidPoints<D>& fluid, double length, std::vector<double>& impulse);

  double given() const { return given_.value(); }  ///< since the start [kg]
  void visit_state(StateVisitor& visitor);

 private:
  double find_weights(const FluidPoints<D>& fluid, std::size_t mouth);

  std::array<std::vector<double>, D> place_;
  PointSet point_set_;
  std::vector<std::vector<Index>> beside_;  ///< by mouth: the body's points that take the momentum
  double horizon_;
  GaussianInfluence influence_;
  double window_ = 0.0;

  std::vector<double> pressure_, stiffness_, intake_;
  std::vector<double> given_now_;  ///< state: over the last window, its last step left out [kg]
  std::vector<double> last_;       ///< state: in the last step [kg]
  std::vector<double> owed_;       ///< state, by mouth [kg]
  RunningTotal given_;
  std::vector<std::pair<Index, double>> weights_;  // workspace: omega m of the points at a mouth
};

/// Where the inlets of the scene's crack_fluid that hold the fluid's pressure lie; none without.
template <int D>
std::vector<Vector<D>> read_mouths(const Section& scene, const Body<D>* body);

}  // namespace perifrac
