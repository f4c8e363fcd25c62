#pragma once

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Where a fluid point is over a wall point: `normal` is that of the wall's surface.
template <int D>
struct PlaceOverWall {
  Index w;
  Vector<D> normal;
  Vector<D> y;      ///< from the wall point [m]
  double distance;  ///< along the normal [m]

  PlaceOverWall(const FluidStep<D>& step, const NearWalls<D>& walls, Index i, Index near)
      : w(near),
        normal(vector_at(step.cloud.normal, walls.wall[near])),
        y(step.points.at(i) - walls.at(near)),
        distance(dot(normal, y)) {}

  double aside_square() const { return squared_norm(y) - distance * distance; }
  /// Where along the surface the point lies, off the wall point [m].
  Vector<D> aside() const { return y - distance * normal; }
  /// Above the surface [m].
  double height(const FluidStep<D>& step, const NearWalls<D>& walls) const {
    return std::max(0.0, distance - step.cloud.depth[walls.wall[w]]);
  }
};

/// Calls use(w, normal, height) for the near wall points right below fluid point i: w may be an
/// image. Where there is none but a crack has parted the surface below, for those on either side of
/// it: cracks take fluid by their own rules, not its points.
template <int D, class Use>
void for_walls_below(const FluidStep<D>& step, const NearWalls<D>& walls, Index i, Use&& use) {
  // A point in front of a wall has one of its points this near along the surface, or lies between
  // two that are not much farther.
  const double below = (D == 2 ? 0.51 : 0.72) * step.scheme.spacing;
  const double beside = 0.9 * step.scheme.spacing;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  bool found = false;
  for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
    const PlaceOverWall<D> one(step, walls, i, near.other[k]);
    if (one.aside_square() > below * below) continue;
    use(one.w, one.normal, one.height(step, walls));
    found = true;
  }
  if (found) return;
  for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
    const PlaceOverWall<D> one(step, walls, i, near.other[k]);
    if (one.aside_square() > beside * beside) continue;
    for (Index n = near.offset[i]; n < k; ++n) {
      const PlaceOverWall<D> other(step, walls, i, near.other[n]);
      if (other.aside_square() > beside * beside || dot(one.normal, other.normal) < 0.99 ||
          dot(one.aside(), other.aside()) >= 0.0) {
        continue;
      }
      use(one.w, one.normal, one.height(step, walls));
      use(other.w, other.normal, other.height(step, walls));
    }
  }
}

/// Keeps fluid out of intact walls: the nearer a point is to a wall's surface, the slower it may
/// approach, so that it never crosses. What that takes of its momentum is added to the force on the
/// wall point over a step of `length` [s]. At rest, half a spacing off, this allows a quarter of
/// the speed of sound, so that pressure alone turns all but violent flow. Returns the heat [J].
template <int D>
double stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                     NearWalls<D>& walls);

}  // namespace perifrac
