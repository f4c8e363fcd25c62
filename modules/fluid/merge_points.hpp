#pragma once

#include "core/operators/neighbour_traversal.hpp"
#include "modules/fluid/fluid_neighbours.hpp"

namespace perifrac {

/// Removes points of less mass than `least` [kg] and gives what they had to their neighbours, each
/// a share in proportion to omega V (paper Eq 29), with its mass, volume and momentum; a receiver
/// moves to where the centre of mass of itself and its share is. A point without neighbours stays.
/// Needs lists and volumes of now; returns how many are gone, after which lists must be made anew.
template <int D>
Index merge_points(FluidPoints<D>& points, const FluidNeighbours<D>& neighbours,
                   const GaussianInfluence& influence, double least);

}  // namespace perifrac
