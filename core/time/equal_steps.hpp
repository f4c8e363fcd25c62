#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace perifrac {

/// The fewest equal steps, each at most `longest` [s], that make up `length` [s]. A window that was
/// chosen as long as one step is one step, whatever rounding its ends went through.
inline std::int64_t equal_steps(double length, double longest) {
  constexpr double rounding = 1e-9;
  return std::max<std::int64_t>(
      1, static_cast<std::int64_t>(std::ceil(length / longest * (1.0 - rounding))));
}

}  // namespace perifrac
