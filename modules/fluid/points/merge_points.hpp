#pragma once

#include "core/geometry/neighbour_traversal.hpp"
#include "modules/fluid/points/fluid_neighbours.hpp"

namespace perifrac {

/// Points of less mass than `least` [kg] give what they have to their neighbours, each a share in
/// proportion to omega V (paper Eq 29), with its mass, volume and momentum; a receiver moves to
/// where the centre of mass of itself and its share is. A point without neighbours keeps its mass.
/// Needs lists and volumes of now; returns how many were left with a mass of 0, to be removed.
template <int D>
Index merge_points(FluidPoints<D>& points, const FluidNeighbours<D>& neighbours,
                   const PairInfluence& influence, double least);

}  // namespace perifrac
