#pragma once

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Calls use(w, normal, height) for the near wall points right below fluid point i: w may be an
/// image, `normal` is that of the wall's surface, and `height` [m] that of the point above it.
template <int D, class Use>
void for_walls_below(const FluidStep<D>& step, const NearWalls<D>& walls, Index i, Use&& use) {
  // A point in front of a wall has one of its points this near along the surface.
  const double aside = (D == 2 ? 0.51 : 0.72) * step.scheme.spacing;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
    const Index w = near.other[k];
    const Index wall = walls.wall[w];
    const Vector<D> normal = vector_at(step.cloud.normal, wall);
    const Vector<D> y = step.points.at(i) - walls.at(w);
    const double square = squared_norm(y), normal_distance = dot(normal, y);
    if (square - normal_distance * normal_distance > aside * aside) continue;
    use(w, normal, std::max(0.0, normal_distance - step.cloud.depth[wall]));
  }
}

/// Keeps fluid out of intact walls: the nearer a point is to a wall's surface, the slower it may
/// approach, so that it never crosses. What that takes of its momentum is added to the force on the
/// wall point over a step of `length` [s]. At rest, half a spacing off, this allows a quarter of
/// the speed of sound, so that pressure alone turns all but violent flow.
template <int D>
void stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                   NearWalls<D>& walls);

}  // namespace perifrac
