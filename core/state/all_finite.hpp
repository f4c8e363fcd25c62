#pragma once

#include <bit>
#include <cstdint>
#include <span>

namespace perifrac {

/// No value is infinite or not a number. Looks at bits, which packets do at once.
inline bool all_finite(std::span<const double> values) {
  constexpr auto infinite = std::uint64_t{0x7ff} << 52;
  std::uint64_t bad = 0;
  for (const double value : values) {
    bad |= (std::bit_cast<std::uint64_t>(value) & infinite) == infinite ? 1 : 0;
  }
  return bad == 0;
}

}  // namespace perifrac
