#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

/// N numbers of every node, positions in front, that sums over bonds read of the other ends; the
/// arrays they are in must stay. In 3D, where bonds are many, they can be read by rows; in 2D
/// columns are as fast.
template <int D, int N>
class NodeValues {
 public:
  void read_by_rows() { by_rows_ = D == 3; }
  bool reads_rows() const { return by_rows_; }

  /// The numbers from `first` on.
  template <int first, std::size_t count>
  void put(const std::array<std::span<const double>, count>& columns) {
    static_assert(first + count <= N);
    for (std::size_t k = 0; k < count; ++k) columns_.column[first + k] = columns[k].data();
    if (!by_rows_) return;
    rows_.resize(static_cast<Index>(columns[0].size()));
    rows_.template put<first>(columns);
  }

  /// use(values), for sum_over_bonds().
  template <class Use>
  auto with(Use&& use) const {
    if constexpr (D == 3) {
      if (by_rows_) return use(rows_);
    }
    return use(columns_);
  }

 private:
  bool by_rows_ = false;
  NodeColumns<N> columns_{};
  NeighbourRows<N> rows_;
};

}  // namespace perifrac
