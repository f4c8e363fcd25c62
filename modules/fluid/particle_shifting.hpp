#pragma once

#include "modules/fluid/fluid_moments.hpp"

namespace perifrac {

/// Moves points away from where they crowd, as far as `strength` times the way that they made in a
/// step of `length` [s] times their crowding in spacings (after Lind et al. 2012): flow draws
/// points out into threads, and uniform pressure does not mind. Points at a free surface stay.
/// Velocity, density and mass go along: momentum and mass are kept, angular momentum is not.
template <int D>
void shift_points(double strength, double length, double spacing, const FluidMoments<D>& moments,
                  FluidPoints<D>& points);

}  // namespace perifrac
