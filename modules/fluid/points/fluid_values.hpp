#pragma once

#include <array>
#include <vector>

#include "core/geometry/neighbour_values.hpp"

namespace perifrac {

/// What fluid points, images included, bring to most sums of their neighbours: position, a vector
/// (from number D on) and two numbers (from 2 D on).
template <int D>
class FluidValues : public NeighbourValues<D, 2 * D + 2> {
 public:
  using Vectors = std::array<std::vector<double>, D>;

  void set(const Vectors& position, const Vectors& vector, const std::vector<double>& one,
           const std::vector<double>& other) {
    std::array<std::span<const double>, 2 * D + 2> columns;
    for (int a = 0; a < D; ++a) {
      columns[a] = position[a];
      columns[D + a] = vector[a];
    }
    columns[2 * D] = one;
    columns[2 * D + 1] = other;
    NeighbourValues<D, 2 * D + 2>::set(columns);
  }
};

}  // namespace perifrac
