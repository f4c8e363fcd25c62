#include "core/geometry/space_filling_curve.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace perifrac {

namespace {

constexpr int curve_bits = 20;  // cells an axis: 2^20; three axes fit one 64-bit key

/// Place of a cell on the Hilbert curve: Skilling, AIP Conf. Proc. 707 (2004), axes to transpose.
template <int D>
std::uint64_t hilbert_key(std::array<std::uint32_t, D> cell) {
  for (std::uint32_t bit = 1u << (curve_bits - 1); bit > 1; bit >>= 1) {
    for (int a = 0; a < D; ++a) {
      if (cell[a] & bit) {
        cell[0] ^= bit - 1;
      } else {
        const std::uint32_t swap = (cell[0] ^ cell[a]) & (bit - 1);
        cell[0] ^= swap;
        cell[a] ^= swap;
      }
    }
  }
  for (int a = 1; a < D; ++a) cell[a] ^= cell[a - 1];
  std::uint32_t flip = 0;
  for (std::uint32_t bit = 1u << (curve_bits - 1); bit > 1; bit >>= 1) {
    if (cell[D - 1] & bit) flip ^= bit - 1;
  }
  std::uint64_t key = 0;
  for (int bit = curve_bits - 1; bit >= 0; --bit) {
    for (int a = 0; a < D; ++a) key = (key << 1) | (((cell[a] ^ flip) >> bit) & 1u);
  }
  return key;
}

}  // namespace

template <int D>
std::vector<Index> order_along_curve(const Positions<D>& position, double spacing) {
  const Index n = static_cast<Index>(position[0].size());
  std::vector<std::uint64_t> key(n);
  Vector<D> low;
  for (int a = 0; a < D; ++a) {
    low[a] = n == 0 ? 0.0 : *std::ranges::min_element(position[a]);
  }
  for (Index i = 0; i < n; ++i) {
    std::array<std::uint32_t, D> cell;
    for (int a = 0; a < D; ++a) {
      cell[a] = static_cast<std::uint32_t>(std::floor((position[a][i] - low[a]) / spacing + 0.5));
    }
    key[i] = hilbert_key<D>(cell);
  }
  std::vector<Index> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Index i) { return key[i]; });
  return order;
}

template <int D>
void sort_along_curve(Points<D>& points, double spacing) {
  const Index n = points.size();
  const std::vector<Index> order = order_along_curve<D>(positions_of(points.position), spacing);
  const auto reorder = [&](std::vector<double>& values) {
    std::vector<double> sorted(values.size());
    for (Index i = 0; i < n; ++i) sorted[i] = values[order[i]];
    values = std::move(sorted);
  };
  for (auto& coordinate : points.position) reorder(coordinate);
  reorder(points.volume);
}

template std::vector<Index> order_along_curve<2>(const Positions<2>&, double);
template std::vector<Index> order_along_curve<3>(const Positions<3>&, double);
template void sort_along_curve<2>(Points<2>&, double);
template void sort_along_curve<3>(Points<3>&, double);

}  // namespace perifrac
