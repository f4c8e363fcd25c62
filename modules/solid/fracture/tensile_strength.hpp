#pragma once

#include <cmath>
#include <optional>

#include "core/geometry/by_region.hpp"
#include "core/geometry/scatter.hpp"

namespace perifrac {

/// The tension that rock without a crack bears, from place to place [Pa].
template <int D>
struct TensileStrength {
  ByRegion<D, double> by_region;
  /// That of the fracture energy, of which the strength has the root: the length E' Gc / strength^2
  /// does not scatter.
  std::optional<Scatter<D>> scatter{};

  double at(const Vector<D>& x) const {
    const double strength = by_region.at(x);
    return scatter ? strength * std::sqrt(scatter->factor(x)) : strength;
  }
};

}  // namespace perifrac
