#pragma once

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// The last of a fluid point, of less mass than `least` [kg], goes into the pores of the body's
/// points near it, in proportion to omega V, and its momentum into these points: their
/// `exchanged_mass` [kg] and `impulse`, D blocks [N s], grow. It would only ever become smaller.
/// Returns how many were left with a mass of 0, to be removed.
template <int D>
Index soak_points(const FluidStep<D>& step, const NearWalls<D>& walls, double least,
                  FluidPoints<D>& points, std::vector<double>& exchanged_mass,
                  std::vector<double>& impulse);

}  // namespace perifrac
