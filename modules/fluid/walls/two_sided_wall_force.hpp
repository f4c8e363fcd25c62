#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Wall points stand in for fluid: each has the pressure that the fluid about it would have there,
/// p = sum w (p_f + rho g.dr) / sum w, not below 0, and the shape tensor of an endless lattice; the
/// pair force is that between fluid points. Where a wall does not slip, it has besides the velocity
/// that makes the fluid's, linear across the surface, that of the wall there.
template <int D>
class TwoSidedWallForce final : public WallForce<D> {
 public:
  void add(const FluidStep<D>& step, NearWalls<D>& walls, FluidForces<D>& forces) override;

 private:
  void extrapolate_pressure(const FluidStep<D>& step, NearWalls<D>& walls) const;
};

}  // namespace perifrac
