#pragma once

#include "modules/fluid/points/fluid_neighbours.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Splits every point of more than `most` [kg] into two of half its mass, its density and velocity,
/// about its place: mass, momentum and centre of mass stay. They come to lie as far apart as points
/// of their size do, along the axis or diagonal of space that has the most room. Needs neighbour
/// lists; returns how many were split, after which lists must be made anew.
template <int D>
Index split_points(FluidPoints<D>& points, const NearWalls<D>& walls,
                   const FluidNeighbours<D>& neighbours, double most);

}  // namespace perifrac
