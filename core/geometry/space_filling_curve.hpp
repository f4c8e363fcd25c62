#pragma once

#include "core/base/points.hpp"

namespace perifrac {

/// Reorders points along a Hilbert curve over cells of size `spacing` [m], so that points close in
/// space are close in memory. Ties keep their order.
template <int D>
void sort_along_curve(Points<D>& points, double spacing);

}  // namespace perifrac
