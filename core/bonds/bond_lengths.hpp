#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

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
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      double square = 0.0;
      for (int a = 0; a < D; ++a) {
        const double xi = family.position[a][family.other[bond]] - family.position[a][i];
        square += xi * xi;
      }
      shortest = std::min(shortest, square);
      longest = std::max(longest, square);
    }
  }
  return {std::sqrt(shortest), std::sqrt(longest)};
}

}  // namespace perifrac
