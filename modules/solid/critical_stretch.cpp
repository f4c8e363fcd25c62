#include "modules/solid/critical_stretch.hpp"

#include <algorithm>
#include <cmath>

#include "core/geometry/crack_cut.hpp"
#include "core/operators/bond_traversal.hpp"
#include "modules/solid/stiffness_bound.hpp"

namespace perifrac {

namespace {

/// The ends of bonds, each once, ascending.
std::vector<Index> ends_of(std::span<const std::pair<Index, Index>> bonds) {
  std::vector<Index> points;
  for (const auto& [i, j] : bonds) points.insert(points.end(), {i, j});
  std::ranges::sort(points);
  const auto twice = std::ranges::unique(points);
  points.erase(twice.begin(), twice.end());
  return points;
}

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
      overstretched_(family_->point_count) {}

template <int D>
void CriticalStretch<D>::cut_seeds() {
  for (const CrackFacet<D>& seed : seeds_) {
    const Bonds cut = bonds_cut_by<D>(seed, *family_);
    break_in_family(cut, ends_of(cut));
    bonds_.add_facet(seed, cut);
  }
  followed_ = bonds_.version();
  for (Index i = 0; i < family_->point_count; ++i) bound_at_start_.push_back(stiffness_bound(i));
}

template <int D>
bool CriticalStretch<D>::break_stretched(std::span<const double> u) {
  if (std::isinf(limit_)) return false;
  const Bonds bonds = stretched_bonds(u);
  if (bonds.empty()) return false;
  const std::vector<Index> points = ends_of(bonds);
  for (const Index i : points) released_energy_ += elastic_->point_energy(i, u);
  break_in_family(bonds, points);
  for (const Index i : points) released_energy_ -= elastic_->point_energy(i, u);
  bonds_.break_bonds(bonds);
  followed_ = bonds_.version();
  find_growth(points);
  return true;
}

/// Pairs i < j, in the order of the points.
template <int D>
auto CriticalStretch<D>::stretched_bonds(std::span<const double> u) -> Bonds {
  const Index points = family_->point_count;
  const double most = (1.0 + limit_) * (1.0 + limit_);
  const auto for_each_stretched = [&](Index i, auto&& use) {
    for (Index bond = family_->offset[i]; bond < family_->offset[i + 1]; ++bond) {
      const Index j = family_->other[bond];
      if (j >= points) break;  // ghosts come last
      if (j <= i || family_->weight[bond] == 0.0) continue;
      double now = 0.0, square = 0.0;
      for (int a = 0; a < D; ++a) {
        const double xi = family_->position[a][j] - family_->position[a][i];
        const std::size_t block = static_cast<std::size_t>(a) * points;
        const double moved = xi + u[block + j] - u[block + i];
        now += moved * moved;
        square += xi * xi;
      }
      if (now > most * square) use(j);
    }
  };
  for_each_point(points, [&](Index i) {
    overstretched_[i] = 0;
    for_each_stretched(i, [&](Index) { overstretched_[i] = 1; });
  });
  Bonds bonds;
  for (Index i = 0; i < points; ++i) {
    if (overstretched_[i]) for_each_stretched(i, [&](Index j) { bonds.emplace_back(i, j); });
  }
  return bonds;
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
void CriticalStretch<D>::follow_bonds() {
  if (bonds_.version() == followed_) return;
  followed_ = bonds_.version();
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
