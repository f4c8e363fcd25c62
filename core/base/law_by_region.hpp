#pragma once

#include <cstdint>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// A law that differs from region to region; few laws, one byte a point.
template <class Law>
struct LawByRegion {
  static constexpr int components = Law::components;

  std::vector<Law> laws;
  std::vector<std::uint8_t> law_of_point;

  const Law& at(Index i) const { return laws[law_of_point[i]]; }
};

/// The law of point i: the law itself where it is the same everywhere, which then costs nothing.
template <class Law>
decltype(auto) law_at(const Law& law, Index i) {
  if constexpr (requires { law.at(i); }) {
    return law.at(i);
  } else {
    return (law);
  }
}

}  // namespace perifrac
