#pragma once

#include "core/base/points.hpp"

namespace perifrac {

/// Points of a box [first, first + counts] * spacing at cell centres, so that every face lies half
/// a spacing outside the last points. Row by row along the first axis.
template <int D>
Points<D> box_lattice(const std::array<int, D>& counts, double spacing,
                      const std::array<int, D>& first = {});

/// Points of a ball about the origin, or of its octant at positive coordinates (in 2D a quadrant):
/// the cells of a lattice whose centres lie inside `radius` [m]. The volume of a point is the part
/// of the ball that is nearest to it, so that sums over points follow the surface, which the cells
/// do in steps only. Row by row along the first axis.
template <int D>
Points<D> ball_lattice(double radius, double spacing, bool octant = false);

}  // namespace perifrac
