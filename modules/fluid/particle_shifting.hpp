#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Moves points away from where they crowd, as far as `strength` times the way that they made in a
/// step of `length` [s] times their crowding in spacings (after Lind et al. 2012): flow draws
/// points out into threads, and uniform pressure does not mind. Points at a free surface stay,
/// and none goes more than half the way to a wall's surface. Velocity, density and mass go along:
/// mass and momentum are kept; angular momentum, energy and the centre of mass are not.
template <int D>
void shift_points(const FluidStep<D>& step, const NearWalls<D>& walls, double strength,
                  double length, FluidPoints<D>& points);

}  // namespace perifrac
