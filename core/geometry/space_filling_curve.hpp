#pragma once

#include <vector>

#include "core/base/points.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// Numbers of points in the order in which a Hilbert curve over cells of size `spacing` [m] passes
/// them, so that those close in space follow each other closely. Ties keep their order.
template <int D>
std::vector<Index> order_along_curve(const Positions<D>& position, double spacing);

/// Reorders points along a Hilbert curve over cells of size `spacing` [m], so that points close in
/// space are close in memory. Ties keep their order.
template <int D>
void sort_along_curve(Points<D>& points, double spacing);

}  // namespace perifrac
