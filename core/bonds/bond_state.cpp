#include "core/bonds/bond_state.hpp"

#include <algorithm>

#include "core/base/require.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac {

template <int D>
void BondState<D>::add_facet(const CrackFacet<D>& facet,
                             std::span<const std::pair<Index, Index>> bonds) {
  const Index number = static_cast<Index>(facets_.size());
  facets_.push_back(facet);
  for (const auto& [i, j] : bonds) broken_.push_back({i, j, number});
  ++version_;
  place_facets();
}

template <int D>
void BondState<D>::break_bonds(std::span<const std::pair<Index, Index>> bonds) {
  for (const auto& [i, j] : bonds) broken_.push_back({i, j, no_facet});
  ++version_;
}

template <int D>
void BondState<D>::visit_state(StateVisitor& visitor) {
  std::vector<double> corners;
  for (const CrackFacet<D>& facet : facets_) {
    for (const Vector<D>& corner : facet)
      corners.insert(corners.end(), corner.begin(), corner.end());
  }
  std::vector<std::int64_t> bonds;
  for (const BrokenBond& bond : broken_) bonds.insert(bonds.end(), {bond.i, bond.j, bond.facet});
  const std::vector<double> corners_before = corners;
  const std::vector<std::int64_t> bonds_before = bonds;
  visitor.visit("crack_facets", corners);
  visitor.visit("broken_bonds", bonds);
  if (corners == corners_before && bonds == bonds_before) return;

  constexpr std::size_t sides = std::tuple_size_v<CrackFacet<D>>;
  require(corners.size() % (sides * D) == 0 && bonds.size() % 3 == 0,
          "a state of cracks in parts that do not fit");
  facets_.resize(corners.size() / (sides * D));
  for (std::size_t k = 0; k < corners.size(); ++k)
    facets_[k / (sides * D)][k / D % sides][k % D] = corners[k];
  broken_.clear();
  for (std::size_t k = 0; k < bonds.size(); k += 3) {
    broken_.push_back({static_cast<Index>(bonds[k]), static_cast<Index>(bonds[k + 1]),
                       static_cast<Index>(bonds[k + 2])});
  }
  ++version_;
  place_facets();
}

template <int D>
void BondState<D>::place_facets() {
  for (int a = 0; a < D; ++a) {
    centre_[a].clear();
    for (const CrackFacet<D>& facet : facets_) centre_[a].push_back(middle<D>(facet)[a]);
    facet_points_.position[a] = centre_[a];
  }
  facet_points_.count = facets_.size();
  facet_points_.version = version_;
}

template <int D>
void silence(Family<D>& family, Index i, Index j) {
  for (const auto& [from, to] : {std::pair(i, j), std::pair(j, i)}) {
    const PointBonds bonds = family.bonds(from);
    for (Index k = 0; k < bonds.count(); ++k) {
      const Index end = bonds.other(k);
      const Index source =
          end < family.point_count ? end : family.ghost_source[end - family.point_count];
      if (source == to) family.weight.set(from, k, 0.0);
    }
  }
}

void keep_each_once(std::vector<Index>& points) {
  std::ranges::sort(points);
  const auto repeats = std::ranges::unique(points);
  points.erase(repeats.begin(), repeats.end());
}

std::vector<Index> ends_of(std::span<const std::pair<Index, Index>> bonds) {
  std::vector<Index> points;
  for (const auto& [i, j] : bonds) points.insert(points.end(), {i, j});
  keep_each_once(points);
  return points;
}

template <int D>
void find_damage(const Family<D>& family, std::span<double> damage) {
  for_each_point(family.point_count, [&](Index i) {
    double whole = 0.0, lost = 0.0;
    for (const auto& [j, weight] : family.bonds(i)) {
      whole += family.volume[j];
      if (weight == 0.0) lost += family.volume[j];
    }
    damage[i] = whole > 0.0 ? lost / whole : 0.0;
  });
}

template class BondState<2>;
template class BondState<3>;
template void find_damage<2>(const Family<2>&, std::span<double>);
template void find_damage<3>(const Family<3>&, std::span<double>);
template void silence<2>(Family<2>&, Index, Index);
template void silence<3>(Family<3>&, Index, Index);

}  // namespace perifrac
