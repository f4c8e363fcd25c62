#pragma once

#include <algorithm>

#include "core/base/point_set.hpp"
#include "core/geometry/cell_grid.hpp"

namespace perifrac {

/// Places of points along each axis [m]; `D` is the dimension of the points.
template <int D>
Positions<D> places_of(const PointSet& points) {
  Positions<D> places;
  std::copy_n(points.position.begin(), D, places.begin());
  return places;
}

}  // namespace perifrac
