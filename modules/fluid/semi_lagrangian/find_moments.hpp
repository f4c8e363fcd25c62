#pragma once

#include "modules/fluid/points/fluid_moments.hpp"
#include "modules/fluid/points/fluid_neighbours.hpp"
#include "modules/fluid/points/fluid_values.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Finds the moments of all points from positions, velocities, densities and volumes, those of
/// images and near walls included: the shape tensor is each point's own (paper Eqs 19, 23),
/// regularised, the divergence that of Eq 20. `values` are to work with.
template <int D>
void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                  const FluidNeighbours<D>& neighbours, const GaussianInfluence& influence,
                  FluidValues<D>& values, FluidMoments<D>& moments);

}  // namespace perifrac
