#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "core/geometry/region.hpp"
#include "core/geometry/scatter.hpp"

namespace perifrac {

/// The energy that new crack takes per area, both faces together, from place to place [J/m^2].
template <int D>
struct FractureEnergy {
  double elsewhere;                                    ///< outside all regions; may be infinite
  std::vector<std::pair<Region<D>, double>> inside{};  ///< the last that holds a place counts
  std::optional<Scatter<D>> scatter{};

  double at(const Vector<D>& x) const {
    double energy = elsewhere;
    for (const auto& [region, value] : inside) {
      if (region.contains(x)) energy = value;
    }
    return scatter ? energy * scatter->factor(x) : energy;
  }
};

}  // namespace perifrac
