#include "modules/solid/fracture/stretch_budget.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_lengths.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/geometry/space_filling_curve.hpp"

namespace perifrac {

namespace {

constexpr double at_once = -1.0;

/// Of the longest bond: the margin of what is left, and how far a point may be from where it began
/// for rounding to stay far below that.
constexpr double least_margin = 1e-9, farthest = 1e3;

}  // namespace

template <int D>
StretchBudget<D>::StretchBudget(const Family<D>& family)
    : points_(family.point_count), last_(static_cast<std::size_t>(D) * points_) {
  const BondLengths lengths = bond_lengths(family);
  rounding_ = least_margin * lengths.longest;
  order_ = order_along_curve<D>(positions_of(family.position, points_), lengths.shortest);
  for (Index i = 0; i < points_; ++i) {
    real_bonds_.push_back(family.first_ghost_bond(i));
  }
  const Index count = (points_ + block_size - 1) / block_size;
  left_.assign(count, at_once);
  motion_.resize(count);
  first_near_.push_back(0);
  std::vector<Index> block_of(points_), near;
  for (Index k = 0; k < points_; ++k) block_of[order_[k]] = k / block_size;
  for (Index block = 0; block < count; ++block) {
    near.assign(1, block);
    for (const Index i : points(block)) {
      const PointBonds bonds = family.bonds(i);
      for (Index k = 0; k < real_bonds_[i]; ++k) near.push_back(block_of[bonds.other(k)]);
    }
    std::ranges::sort(near);
    near.erase(std::unique(near.begin(), near.end()), near.end());
    near_.insert(near_.end(), near.begin(), near.end());
    first_near_.push_back(static_cast<Index>(near_.size()));
  }
}

template <int D>
void StretchBudget<D>::forget() {
  std::ranges::fill(left_, at_once);
}

template <int D>
std::span<const Index> StretchBudget<D>::due(std::span<const double> u) {
#pragma omp parallel for schedule(static) if (points_ >= points_worth_threads)
  for (Index block = 0; block < blocks(); ++block) motion_[block] = motion_of(block, u);
  watch_rounding(u);
#pragma omp parallel for schedule(static) if (points_ >= points_worth_threads)
  for (Index block = 0; block < blocks(); ++block) left_[block] -= farthest_apart(block);
  due_.clear();
  for (Index block = 0; block < blocks(); ++block) {
    if (!(left_[block] > 0.0)) due_.push_back(block);
  }
  return due_;
}

/// Where displacements are so large that rounding might hide a way, nothing is left alone.
template <int D>
void StretchBudget<D>::watch_rounding(std::span<const double> u) {
  const double most = farthest / least_margin * rounding_;
  double way = 0.0;
  for (const Box& box : motion_) {
    for (int a = 0; a < D; ++a) way = std::max({way, std::abs(box.low[a]), std::abs(box.high[a])});
  }
  largest_ += way;
  if (largest_ < most) return;
  largest_ = 0.0;
  for (std::size_t k = 0; k < last_.size(); ++k) largest_ = std::max(largest_, std::abs(u[k]));
  if (!(largest_ < 0.5 * most)) forget();
}

/// The box that holds the ways of its points since the last call.
template <int D>
auto StretchBudget<D>::motion_of(Index block, std::span<const double> u) -> Box {
  Box box;
  const Index* const own = points(block).data();
  const Index count = static_cast<Index>(points(block).size());
  for (int a = 0; a < D; ++a) {
    const double* const now = u.data() + static_cast<std::size_t>(a) * points_;
    double* const before =
        last_.data() + static_cast<std::size_t>(a) * points_ + block * block_size;
    double low = std::numeric_limits<double>::infinity(), high = -low;
#pragma omp simd reduction(min : low) reduction(max : high)
    for (Index k = 0; k < count; ++k) {
      const double way = now[own[k]] - before[k];
      low = way < low ? way : low;
      high = way > high ? way : high;
      before[k] = now[own[k]];
    }
    box.low[a] = low;
    box.high[a] = high;
  }
  return box;
}

/// A bound of how far any end of its bonds moved against the other.
template <int D>
double StretchBudget<D>::farthest_apart(Index block) const {
  Box box = motion_[block];
  for (Index k = first_near_[block]; k < first_near_[block + 1]; ++k) {
    const Box& near = motion_[near_[k]];
    for (int a = 0; a < D; ++a) {
      box.low[a] = std::min(box.low[a], near.low[a]);
      box.high[a] = std::max(box.high[a], near.high[a]);
    }
  }
  return norm(box.high - box.low);
}

template class StretchBudget<2>;
template class StretchBudget<3>;

}  // namespace perifrac
