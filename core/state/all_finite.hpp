#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <iterator>
#include <span>

#include "core/base/block_sum.hpp"

namespace perifrac {

/// No value is infinite or not a number. Looks at bits, which packets do at once.
inline bool all_finite(std::span<const double> values) {
  constexpr std::size_t size = 2048;
  const std::size_t blocks = (values.size() + size - 1) / size;
  bool finite = true;
#pragma omp parallel for reduction(&& : finite) if (std::ssize(values) >= entries_worth_threads)
  for (std::size_t b = 0; b < blocks; ++b) {
    constexpr auto infinite = std::uint64_t{0x7ff} << 52;
    std::uint64_t bad = 0;
    for (const double value : values.subspan(b * size, std::min(size, values.size() - b * size))) {
      bad |= (std::bit_cast<std::uint64_t>(value) & infinite) == infinite ? 1 : 0;
    }
    finite = finite && bad == 0;
  }
  return finite;
}

}  // namespace perifrac
