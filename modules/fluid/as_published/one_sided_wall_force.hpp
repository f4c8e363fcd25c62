#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// The published force of intact walls on fluid, for comparison: the stress of the fluid point
/// alone, omega sigma M^-1 Y (paper Eq 22, M over fluid and wall points, Eq 23), and a repulsion by
/// wall points of the outermost row that are nearer than a spacing (Eq 24),
///   -C c_0^2 f(eta) (1 - |Y| / spacing) Y / |Y|^2.
/// That is an acceleration, so it is multiplied by the fluid point's mass; f is the B-spline 2/3,
/// then 2 eta - 3/2 eta^2 from eta = 2/3, then (2 - eta)^2 / 2 from 1, with eta = |Y| / (0.75 h)
/// and h half a horizon (Liu, Shao and Chang 2012). Beside the two-sided force between fluid points
/// half the pressure of the wall is missing: water at rest sinks towards it.
template <int D>
class OneSidedWallForce final : public WallForce<D> {
 public:
  explicit OneSidedWallForce(double repulsion) : repulsion_(repulsion) {}

  void add(const FluidStep<D>& step, NearWalls<D>& walls, FluidForces<D>& forces) override;

 private:
  double repulsion_;  ///< C
};

}  // namespace perifrac
