#pragma once

#include <optional>

#include "core/geometry/by_region.hpp"
#include "core/geometry/scatter.hpp"

namespace perifrac {

/// The energy that new crack takes per area, both faces together, from place to place [J/m^2].
template <int D>
struct FractureEnergy {
  ByRegion<D, double> by_region;  ///< may be infinite
  std::optional<Scatter<D>> scatter{};

  double at(const Vector<D>& x) const {
    const double energy = by_region.at(x);
    return scatter ? energy * scatter->factor(x) : energy;
  }
};

}  // namespace perifrac
