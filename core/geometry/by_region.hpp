#pragma once

#include <utility>
#include <vector>

#include "core/geometry/region.hpp"

namespace perifrac {

/// What has another value in some parts of space.
template <int D, class Value>
struct ByRegion {
  Value elsewhere;
  std::vector<std::pair<Region<D>, Value>> inside{};  ///< the last that holds a place counts

  Value at(const Vector<D>& x) const {
    Value value = elsewhere;
    for (const auto& [region, other] : inside) {
      if (region.contains(x)) value = other;
    }
    return value;
  }
};

}  // namespace perifrac
