#pragma once

#include <optional>
#include <span>

namespace perifrac {

/// Period and mean of a recorded oscillation, over the whole periods in it.
struct Oscillation {
  double period;
  double mean;
};

/// Between the first and last upward crossing of `level`, by linear interpolation between the
/// samples; none with fewer than two crossings. A crossing counts once the samples have been on
/// both sides of the level by `hysteresis`, so that higher modes do not add any.
std::optional<Oscillation> oscillation(std::span<const double> times,
                                       std::span<const double> values, double level,
                                       double hysteresis);

}  // namespace perifrac
