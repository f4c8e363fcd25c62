#pragma once

#include "core/base/points.hpp"

namespace perifrac {

/// Gives every point the volume of its Voronoi cell within the box from `low` to `high` [m], in
/// which all points lie, no two at one place: the part of the box that is nearer to it than to any
/// other. `spacing` [m] is about the distance between neighbours.
template <int D>
void set_voronoi_volumes(Points<D>& points, const Vector<D>& low, const Vector<D>& high,
                         double spacing);

}  // namespace perifrac
