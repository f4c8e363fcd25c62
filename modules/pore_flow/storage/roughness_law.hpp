#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "core/base/law_by_region.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// Of the linear-exact operator's energy what linear fields do not have, and that alone; of Darcy
/// flow's size for a mobility of `weight`.
template <int D>
struct RoughnessLaw {
  double weight;

  Tensor<1, D> stress(const Tensor<1, D>&) const { return {}; }
  double stabilisation() const { return 4.0 * D / 3.0 * weight; }
};

/// Another weight at every point.
template <int D>
struct RoughnessLaws {
  static constexpr int components = 1;

  std::vector<RoughnessLaw<D>> laws;

  const RoughnessLaw<D>& at(Index i) const { return laws[i]; }

  std::array<Packet, D> stress(PointPacket, const std::array<Packet, D>&) const { return {}; }
};

}  // namespace perifrac
