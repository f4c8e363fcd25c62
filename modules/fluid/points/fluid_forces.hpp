#pragma once

#include <array>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/ranks.hpp"

namespace perifrac {

/// What a step finds at fluid points.
template <int D>
struct FluidForces {
  std::array<std::vector<double>, D> force;  ///< [N]
  bool finds_heat = true;                    ///< it is wanted now, and is nothing otherwise
  std::vector<double> heat;                  ///< what friction takes of the motion [W]

  void resize(Index count) {
    for (auto& along : force) along.resize(count);
    heat.resize(count);
  }

  /// Every process has found its share.
  void gather() {
    for (auto& along : force) ranks::gather_shares(along, static_cast<Index>(heat.size()));
    if (finds_heat) ranks::gather_shares(heat, static_cast<Index>(heat.size()));
  }
};

}  // namespace perifrac
