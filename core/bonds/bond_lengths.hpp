#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/small_vector.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

/// Of all bonds of a family [m].
struct BondLengths {
  double shortest;  ///< infinite where there is no bond
  double longest;
};

template <int D>
BondLengths bond_lengths(const Family<D>& family) {
  double shortest = std::numeric_limits<double>::infinity(), longest = 0.0;
  for (Index i = 0; i < family.point_count; ++i) {
    for (const auto& bond : family.bonds(i)) {
      const double square =
          squared_norm(vector_at(family.position, bond.other) - vector_at(family.position, i));
      shortest = std::min(shortest, square);
      longest = std::max(longest, square);
    }
  }
  return {std::sqrt(shortest), std::sqrt(longest)};
}

}  // namespace perifrac
