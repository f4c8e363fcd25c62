#include "core/geometry/cell_grid.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

#include <omp.h>

#include "core/base/for_each_point.hpp"
#include "core/base/small_vector.hpp"
#include "core/geometry/append_near.hpp"

namespace perifrac {

namespace {

constexpr double farthest_cell = 1e18;  // differences of cells fit 64 bits

constexpr Index no_place = -1;

bool is_cell(double c) { return std::abs(c) < farthest_cell; }

/// This thread's part of [0, count).
std::array<Index, 2> share_of_thread(Index count) {
  const std::int64_t thread = omp_get_thread_num(), threads = omp_get_num_threads();
  return {static_cast<Index>(count * thread / threads),
          static_cast<Index>(count * (thread + 1) / threads)};
}

}  // namespace

template <int D>
std::int64_t CellGrid<D>::wrapped(std::int64_t c, int axis) const {
  if (c >= 0 && c < size_[axis]) return c;
  const std::int64_t rest = c % size_[axis];
  return rest < 0 ? rest + size_[axis] : rest;
}

template <int D>
typename CellGrid<D>::Cell CellGrid<D>::cell_of(const Vector<D>& x) const {
  Cell cell;
  for (int a = 0; a < D; ++a) {
    const double c = std::floor(x[a] * inverse_width_);
    cell[a] = wrapped(is_cell(c) ? static_cast<std::int64_t>(c) - low_[a] : 0, a);
  }
  return cell;
}

/// As many cells as the box of the points has, an empty margin included, but not many more than
/// there are points: then the longest axes wrap around.
template <int D>
void CellGrid<D>::choose_size(std::size_t points) {
  const double most = std::max(64.0, 4.0 * static_cast<double>(points));
  const auto total = [&] {
    double product = 1.0;
    for (int a = 0; a < D; ++a) product *= static_cast<double>(size_[a]);
    return product;
  };
  while (total() > most) {
    std::int64_t& longest = *std::ranges::max_element(size_);
    longest = std::max<std::int64_t>(longest / 4 * 3, 3);  // three cells in a row must differ
  }
}

template <int D>
void CellGrid<D>::sort_into_cells(const Positions<D>& position) {
  const auto n = static_cast<Index>(position[0].size());
  std::size_t cells = 1;
  for (int a = 0; a < D; ++a) cells *= size_[a];
  first_.assign(cells + 1, 0);
  cell_.resize(n);
  order_.resize(n + packet_size);  // a run's last packet reads on
  place_.resize(n);
#pragma omp parallel for schedule(static) if (n >= points_worth_threads)
  for (Index i = 0; i < n; ++i) {
    const Cell c = cell_of(vector_at(position, i));
    std::int64_t flat = c[D - 1];
    for (int a = D - 2; a >= 0; --a) flat = flat * size_[a] + c[a];
    cell_[i] = static_cast<Index>(flat);
  }
  for (const Index c : cell_) ++first_[c];
  std::inclusive_scan(first_.begin(), first_.end(), first_.begin());
  for (Index i = n - 1; i >= 0; --i) {
    place_[i] = --first_[cell_[i]];
    order_[place_[i]] = i;
  }
}

template <int D>
void CellGrid<D>::build(const Positions<D>& position, double cell) {
  assert(cell > 0.0);
  inverse_width_ = (1.0 - 1e-9) / cell;  // rounding puts no pair within a cell two cells apart
  const auto n = static_cast<Index>(position[0].size());
  for (int a = 0; a < D; ++a) {
    double low = farthest_cell, high = -farthest_cell;
    for (const double x : position[a]) {
      const double c = std::floor(x * inverse_width_);
      low = is_cell(c) ? std::min(low, c) : low;
      high = is_cell(c) ? std::max(high, c) : high;
    }
    low_[a] = low > high ? 0 : static_cast<std::int64_t>(low) - 1;
    size_[a] = low > high ? 3 : static_cast<std::int64_t>(high) - low_[a] + 2;
  }
  choose_size(position[0].size());
  sort_into_cells(position);
  for (int a = 0; a < D; ++a) {
    sorted_[a].resize(n + packet_size);
    for (Index k = 0; k < n; ++k) sorted_[a][k] = position[a][order_[k]];
  }
}

template <int D>
typename CellGrid<D>::Runs CellGrid<D>::runs_near(const Vector<D>& x) const {
  const Cell centre = cell_of(x);
  Runs runs;
  const int rows = D == 2 ? 3 : 9;
  for (int row = 0; row < rows; ++row) {
    std::int64_t flat = 0;
    for (int a = D - 1, scale = rows / 3, rest = row; a >= 1; --a, rest %= scale, scale /= 3) {
      flat = flat * size_[a] + wrapped(centre[a] + rest / scale - 1, a);
    }
    flat *= size_[0];
    if (centre[0] >= 1 && centre[0] + 1 < size_[0]) {
      runs.add(first_[flat + centre[0] - 1], first_[flat + centre[0] + 2]);
      continue;
    }
    for (std::int64_t c = centre[0] - 1; c <= centre[0] + 1; ++c) {
      const std::int64_t cell = flat + wrapped(c, 0);
      runs.add(first_[cell], first_[cell + 1]);
    }
  }
  return runs;
}

template <int D>
std::span<Index> CellGrid<D>::points_near(const Vector<D>& x, double reach, Index self,
                                          IndexBlocks& found) const {
  const Runs runs = runs_near(x);
  std::size_t most = packet_size;  // the last packet writes on
  for (int r = 0; r < runs.count; ++r) most += runs.last[r] - runs.first[r];
  const Vector<D> at = x;
  const Index* const order = order_.data();
  std::array<const double*, D> sorted;
  for (int a = 0; a < D; ++a) sorted[a] = sorted_[a].data();
  Index* const begin = found.room(most);
  Index* end = begin;
  for (int r = 0; r < runs.count; ++r) {
    for (Index k = runs.first[r]; k < runs.last[r]; k += packet_size) {
      Packet r_square{};
      for (int a = 0; a < D; ++a) {
        const Packet y = load(sorted[a] + k) - at[a];
        r_square += y * y;
      }
      end += append_near(r_square, reach * reach, runs.last[r] - k, self - k, order + k, end);
    }
  }
  found.take(end - begin);
  return {begin, end};
}

template <int D>
template <class Target, class Place>
void CellGrid<D>::search(Index targets, double reach, Target&& target, Place&& place_of_self,
                         Neighbours& result) {
  assert(reach * inverse_width_ <= 1.0 + 1e-12);
  result.offset.resize(targets + 1);
  result.offset[0] = 0;
  found_.resize(std::max(found_.size(), static_cast<std::size_t>(omp_get_max_threads())));
#pragma omp parallel if (targets >= points_worth_threads)
  {
    IndexBlocks& found = found_[omp_get_thread_num()];
    found.clear();
    const auto [begin, end] = share_of_thread(targets);
    for (Index i = begin; i < end; ++i) {
      const std::span<Index> own = points_near(target(i), reach, place_of_self(i), found);
      if (!std::ranges::is_sorted(own)) std::ranges::sort(own);
      result.offset[i + 1] = static_cast<Index>(own.size());
    }
#pragma omp barrier
#pragma omp single
    {
      for (Index i = 0; i < targets; ++i) result.offset[i + 1] += result.offset[i];
      result.other.resize(result.offset[targets]);
    }
    found.copy_to(result.other.data() + result.offset[begin]);
  }
}

template <int D>
void CellGrid<D>::find(const Positions<D>& targets, double reach, Neighbours& result) {
  search(
      static_cast<Index>(targets[0].size()), reach, [&](Index i) { return vector_at(targets, i); },
      [](Index) { return no_place; }, result);
}

template <int D>
void CellGrid<D>::find_others(Index first, Index last, double reach, Neighbours& result) {
  search(
      last - first, reach, [&](Index k) { return vector_at(sorted_, place_[first + k]); },
      [&](Index k) { return place_[first + k]; }, result);
}

template class CellGrid<2>;
template class CellGrid<3>;

}  // namespace perifrac
