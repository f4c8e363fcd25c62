#pragma once

#include <span>

#include "core/body/body.hpp"

namespace perifrac {

/// The largest step from one value of points on a lattice to the next along an axis, as a part of
/// all that they range over; 1 of irregular points, of which that is not known.
template <int D>
double largest_step(const Body<D>& body, std::span<const double> values);

/// How far values of points on a lattice swing from one to the next, as a part of all that they
/// range over: the largest step between two that goes against the steps before and after it along
/// its axis. 0 of values without such a step, which smooth ones have not; of irregular points, too.
template <int D>
double largest_swing(const Body<D>& body, std::span<const double> values);

}  // namespace perifrac
