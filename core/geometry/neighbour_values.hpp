#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <span>
#include <type_traits>
#include <vector>

#include <Eigen/Core>

#include "core/base/for_each_point.hpp"
#include "core/base/packet.hpp"
#include "core/base/points.hpp"

namespace perifrac {

/// N numbers of every point, each in an array of its own, which must stay.
template <int N>
class NeighbourColumns {
 public:
  /// Of some points, read when they are asked for.
  struct Packets {
    const NeighbourColumns& of;
    const Index* j;
    Packet operator[](int k) const { return perifrac::gather(of.columns_[k], j); }
  };

  void set(const std::array<std::span<const double>, N>& columns) { columns_ = columns; }
  /// Of points j[0], j[1], ...
  Packets gather(const Index* j) const { return {*this, j}; }

 private:
  std::array<std::span<const double>, N> columns_;
};

/// The same side by side, read a row at a time and turned into packets.
template <int N>
class NeighbourRows {
 public:
  using Packets = std::array<Packet, N>;

  void set(const std::array<std::span<const double>, N>& columns) {
    resize(static_cast<Index>(columns[0].size()));
    put<0>(columns);
  }

  void resize(Index count) { rows_.resize(width * count); }
  /// The numbers from `first` on.
  template <int first, std::size_t count>
  void put(const std::array<std::span<const double>, count>& columns) {
    static_assert(first + count <= N);
    const auto points = static_cast<Index>(rows_.size() / width);
    assert(
        std::ranges::all_of(columns, [&](const auto& one) { return std::ssize(one) >= points; }));
    for_each_point(points, [&](Index i) {
      double* const row = &rows_[width * i + first];
      for (std::size_t k = 0; k < count; ++k) row[k] = columns[k][i];
    });
  }

  /// Of points j[0], j[1], ..., the first `count`.
  template <int count = N>
  [[gnu::always_inline]] std::array<Packet, count> gather(const Index* j) const {
    std::array<Packet, count> result;
    gather_from<0, count>(j, result);
    return result;
  }

 private:
  static constexpr std::size_t width = (N + packet_size - 1) / packet_size * packet_size;

  template <int first, int count>
  [[gnu::always_inline]] void gather_from(const Index* j, std::array<Packet, count>& result) const {
    constexpr int used = std::min(packet_size, count - first);
    std::array<Packet, packet_size> block;
#pragma GCC unroll 8
    for (int l = 0; l < packet_size; ++l) block[l] = load(rows_.data() + width * j[l] + first);
    transpose(block);
#pragma GCC unroll 8
    for (int k = 0; k < used; ++k) result[first + k] = block[k];
    if constexpr (first + packet_size < count) gather_from<first + packet_size, count>(j, result);
  }

  std::vector<double, Eigen::aligned_allocator<double>> rows_;
};

/// What points bring to the sums of their neighbours, positions first. Rows are faster, but in 2D
/// where it takes two (decision 11).
template <int D, int N>
using NeighbourValues = std::conditional_t<D == 3 || N <= 8, NeighbourRows<N>, NeighbourColumns<N>>;

}  // namespace perifrac
