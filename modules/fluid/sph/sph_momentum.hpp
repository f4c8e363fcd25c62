#pragma once

#include "core/geometry/wendland_influence.hpp"
#include "modules/fluid/points/fluid_values.hpp"
#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Sets the force on each fluid point by the others,
///   V_i sum_j V_j [-(p_i + p_j) grad W_ij + 2 mu omega / b (v_j - v_i)]:
/// the symmetric sum, which pairs with the divergence so that pressure's work is what compression
/// takes up, and the viscosity of Morris, Fox and Zhu (1997), physical or artificial, whichever is
/// larger. Sound in a lattice under tension would be unstable; walls and surfaces bear none.
/// And its heat, half that of each pair. `values` are to work with.
template <int D>
void find_sph_forces(const FluidStep<D>& step, const WendlandInfluence& influence,
                     FluidValues<D>& values, FluidForces<D>& forces);

}  // namespace perifrac
