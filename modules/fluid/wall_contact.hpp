#pragma once

#include "modules/fluid/wall_force.hpp"

namespace perifrac {

/// Keeps fluid out of intact walls: the nearer a point is to a wall's surface, the slower it may
/// approach, so that it never crosses. What that takes of its momentum is added to the force on the
/// wall point over a step of `length` [s]. At rest, half a spacing off, this allows a quarter of
/// the speed of sound, so that pressure alone turns all but violent flow.
template <int D>
void stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                   NearWalls<D>& walls);

}  // namespace perifrac
