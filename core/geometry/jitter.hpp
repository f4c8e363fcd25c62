#pragma once

#include <cstdint>

#include "core/base/points.hpp"

namespace perifrac {

/// Moves every coordinate of every point by a random length, uniform within +-`distance` [m]. The
/// same seed gives the same points on every machine: the length depends on seed, number of the
/// point and axis alone.
template <int D>
void jitter_points(Points<D>& points, double distance, std::uint64_t seed);

/// The same, but points that would leave the ball of `radius` [m] about the origin stay.
template <int D>
void jitter_points_in_ball(Points<D>& points, double distance, std::uint64_t seed, double radius);

}  // namespace perifrac
