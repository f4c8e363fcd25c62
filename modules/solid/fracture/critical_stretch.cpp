#include "modules/solid/fracture/critical_stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_lengths.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "core/bonds/crack_cut.hpp"
#include "core/profile/profile.hpp"
#include "modules/solid/material/stiffness_bound.hpp"

namespace perifrac {

namespace {

/// The bounds of single points say how the whole compares only within this factor: 1.43 at most was
/// met among bodies torn at random, most of which are far below.
constexpr double margin = 1.5;

std::vector<Index> all_points(Index count) {
  std::vector<Index> points(count);
  for (Index i = 0; i < count; ++i) points[i] = i;
  return points;
}

}  // namespace

template <int D>
CriticalStretch<D>::CriticalStretch(std::shared_ptr<Family<D>> family,
                                    std::shared_ptr<BreakableElasticity<D>> elastic,
                                    BondState<D>& bonds, std::vector<CrackFacet<D>> seeds,
                                    double limit)
    : family_(std::move(family)),
      elastic_(std::move(elastic)),
      bonds_(bonds),
      seeds_(std::move(seeds)),
      limit_(limit),
      intact_weight_(family_->weight),
      growth_of_(family_->point_count, 1.0),
      budget_(*family_),
      overstretched_(family_->point_count) {}

template <int D>
void CriticalStretch<D>::cut_seeds() {
  const double longest = seeds_.empty() ? 0.0 : bond_lengths(*family_).longest;
  for (const CrackFacet<D>& seed : seeds_) {
    const Bonds cut = bonds_cut_by<D>(seed, *family_, longest);
    break_in_family(cut, ends_of(cut));
    bonds_.add_facet(seed, cut);
  }
  followed_ = bonds_.version();
  for (Index i = 0; i < family_->point_count; ++i) bound_at_start_.push_back(stiffness_bound(i));
}

template <int D>
bool CriticalStretch<D>::breaks(std::span<const double> u) {
  if (std::isinf(limit_)) return false;
  const ProfileScope profiled("damage");
  const Bonds bonds = stretched_bonds(u);
  if (bonds.empty()) return false;
  const std::vector<Index> points = ends_of(bonds);
  const DeformedMaterial<D> deformed = elastic_->deform(u);
  for (const Index i : points) released_energy_ += deformed.energy(i);
  break_in_family(bonds, points);
  for (const Index i : points) released_energy_ -= deformed.energy(i);
  bonds_.break_bonds(bonds);
  followed_ = bonds_.version();
  find_growth(points);
  return true;
}

/// Pairs i < j, block by block.
template <int D>
auto CriticalStretch<D>::stretched_bonds(std::span<const double> u) -> Bonds {
  const std::span<const Index> due = budget_.due(u);
  const Index count = static_cast<Index>(due.size());
#pragma omp parallel for schedule(dynamic, \
                                  8) if (count * budget_.block_size >= points_worth_threads)
  for (Index k = 0; k < count; ++k) {
    double least = std::numeric_limits<double>::infinity();
    for (const Index i : budget_.points(due[k])) {
      const double left = left_to_limit(i, u);
      overstretched_[i] = left < budget_.rounding();
      least = std::min(least, left);
    }
    budget_.set_left(due[k], least);
  }
  Bonds bonds;
  for (const Index block : due) {
    for (const Index i : budget_.points(block)) {
      if (overstretched_[i]) append_stretched(i, u, bonds);
    }
  }
  return bonds;
}

/// How far the ends of the bonds to points j > i may at least still part, where that is positive
/// [m]: of L = (1 + s0) |xi| and d = |xi + du| < L, (L^2 - d^2) / (2 L) < L - d.
template <int D>
double CriticalStretch<D>::left_to_limit(Index i, std::span<const double> u) const {
  const Index points = family_->point_count;
  const double most = (1.0 + limit_) * (1.0 + limit_);
  Vector<D> x, own;
  std::array<const double*, D> position, moved;
  for (int a = 0; a < D; ++a) {
    position[a] = family_->position[a].data();
    moved[a] = u.data() + static_cast<std::size_t>(a) * points;
    x[a] = position[a][i];
    own[a] = moved[a][i];
  }
  const Index* const step = family_->steps[i].data();
  const Index count = budget_.real_bonds(i);
  constexpr double whole = std::numeric_limits<double>::infinity();
  const double smallest = family_->weight.with(i, [&](const auto& weight) {
    double least = whole;
#pragma omp simd reduction(min : least)
    for (Index k = 0; k < count; ++k) {
      const Index j = i + step[k];
      double now = 0.0, square = 0.0;
      for (int a = 0; a < D; ++a) {
        const double xi = position[a][j] - x[a];
        const double after = xi + moved[a][j] - own[a];
        now += after * after;
        square += xi * xi;
      }
      const double left = (most * square - now) / std::sqrt(square);
      const double counted = ((j > i) & (weight[k] != 0.0)) ? left : whole;
      least = counted < least ? counted : least;
    }
    return least;
  });
  return smallest / (2.0 * (1.0 + limit_));
}

template <int D>
void CriticalStretch<D>::append_stretched(Index i, std::span<const double> u, Bonds& bonds) const {
  const Index points = family_->point_count;
  const double most = (1.0 + limit_) * (1.0 + limit_);
  const PointBonds own = family_->bonds(i);
  for (Index k = 0; k < budget_.real_bonds(i); ++k) {
    const Index j = own.other(k);
    if (j <= i || own.weight(k) == 0.0) continue;
    const Vector<D> xi = vector_at(family_->position, j) - vector_at(family_->position, i);
    const Vector<D> moved = xi + vector_at<D>(u, points, j) - vector_at<D>(u, points, i);
    if (squared_norm(moved) > most * squared_norm(xi)) bonds.emplace_back(i, j);
  }
}

template <int D>
void CriticalStretch<D>::break_in_family(std::span<const std::pair<Index, Index>> bonds,
                                         std::span<const Index> points) {
  for (const auto& [i, j] : bonds) silence(*family_, i, j);
  elastic_->update(points);
}

template <int D>
double CriticalStretch<D>::stiffness_bound(Index i) const {
  return perifrac::stiffness_bound(*family_, elastic_->law(i), i);
}

template <int D>
void CriticalStretch<D>::find_growth(std::span<const Index> points) {
  for (const Index i : points) {
    if (!(bound_at_start_[i] > 0.0)) continue;
    growth_of_[i] = std::max(1.0, margin * stiffness_bound(i) / bound_at_start_[i]);
  }
  growth_ = *std::ranges::max_element(growth_of_);
}

template <int D>
void CriticalStretch<D>::visit_state(StateVisitor& visitor) {
  visitor.visit("fracture_energy", released_energy_);
  bonds_.visit_state(visitor);
}

template <int D>
void CriticalStretch<D>::follow_state() {
  if (bonds_.version() == followed_) return;
  followed_ = bonds_.version();
  budget_.forget();
  family_->weight = intact_weight_;
  Bonds stretched;
  for (const BrokenBond& bond : bonds_.broken()) {
    silence(*family_, bond.i, bond.j);
    if (bond.facet == no_facet) stretched.emplace_back(bond.i, bond.j);
  }
  elastic_->update(all_points(family_->point_count));
  std::ranges::fill(growth_of_, 1.0);
  find_growth(ends_of(stretched));
}

template class CriticalStretch<2>;
template class CriticalStretch<3>;

}  // namespace perifrac
