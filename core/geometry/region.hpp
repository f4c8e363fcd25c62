#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "core/base/points.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A named part of space, where a physics may have other properties: an axis-parallel box.
template <int D>
struct Region {
  std::string name;
  Vector<D> from;  ///< [m], -infinity where it does not end
  Vector<D> to;    ///< [m]

  bool contains(const Vector<D>& x) const {
    for (int a = 0; a < D; ++a) {
      if (x[a] < from[a] || x[a] > to[a]) return false;
    }
    return true;
  }
};

/// The keys of `regions` in the section of the body.
KeyTable region_keys();

/// Reads them; throws InputError.
template <int D>
std::vector<Region<D>> read_regions(const Section& body);

/// For every point the number of the region, among those that the physics' own `regions` names,
/// that it lies in, plus 1; 0: in none. Throws InputError for a region that the body does not have
/// or that holds no point, and where two have a point in common.
template <int D>
std::vector<std::uint8_t> region_of_points(const Section& physics,
                                           const std::vector<Region<D>>& regions,
                                           const Points<D>& points);

}  // namespace perifrac
