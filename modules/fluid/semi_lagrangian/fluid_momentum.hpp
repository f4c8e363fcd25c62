#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Position, velocity, volume, trace of the shape tensor and stress of all fluid points, images
/// included.
template <int D>
using ForceValues = NeighbourValues<D, 2 * D + 2 + symmetric_size<D>>;

/// Sets the force on each fluid point by the others: pressure in the antisymmetric pair form (paper
/// Eq 21) and viscosity, physical and artificial, as a pair Laplacian; and its heat, half that of
/// each pair. `values` are to work with.
template <int D>
void find_pair_forces(const FluidStep<D>& step, const GaussianInfluence& influence,
                      ForceValues<D>& values, FluidForces<D>& forces);

}  // namespace perifrac
