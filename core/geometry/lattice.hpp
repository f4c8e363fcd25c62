#pragma once

#include "core/geometry/points.hpp"

namespace perifrac {

/// Points of a box [first, first + counts] * spacing at cell centres, so that every face lies half
/// a spacing outside the last points. Sorted along a space-filling curve.
template <int D>
Points<D> box_lattice(const std::array<int, D>& counts, double spacing,
                      const std::array<int, D>& first = {});

/// Points of a ball about the origin: the cells of a lattice whose centres lie inside `radius`
/// [m]; volumes are scaled so that they add up to the ball's. Sorted along a space-filling curve.
template <int D>
Points<D> ball_lattice(double radius, double spacing);

}  // namespace perifrac
