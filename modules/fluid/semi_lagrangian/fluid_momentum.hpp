#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// Sets the force on each fluid point by the others [N]: pressure in the antisymmetric pair form
/// (paper Eq 21) and viscosity, physical and artificial, as a pair Laplacian.
template <int D>
void find_pair_forces(const FluidStep<D>& step, const GaussianInfluence& influence,
                      std::array<std::vector<double>, D>& force);

}  // namespace perifrac
