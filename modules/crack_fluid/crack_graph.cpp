#include "modules/crack_fluid/crack_graph.hpp"

#include <map>
#include <numeric>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

template <int D>
double width(const FacetSide<D>& side) {
  if constexpr (D == 2) return 1.0;
  return norm(side.back() - side.front());
}

}  // namespace

template <int D>
void CrackGraph::build(std::span<const CrackFacet<D>> facets) {
  std::map<FacetSide<D>, std::vector<Branch>> at;
  for (const CrackFacet<D>& facet : facets) {
    const auto number = static_cast<Index>(area_.size());
    area_.push_back(perifrac::area<D>(facet));
    const auto its = sides<D>(facet);
    for (int k = 0; k < std::ssize(its); ++k) at[its[k]].push_back({number, k, width<D>(its[k])});
  }
  crack_.resize(area_.size());
  std::iota(crack_.begin(), crack_.end(), 0);
  const auto first_of = [&](Index facet) {
    while (crack_[facet] != facet) facet = crack_[facet];
    return facet;
  };
  for (const auto& [place, branches] : at) {
    if (branches.size() < 2) continue;
    branches_.insert(branches_.end(), branches.begin(), branches.end());
    offset_.push_back(branches_.size());
    for (const Branch& branch : branches) {
      crack_[first_of(branch.facet)] = first_of(branches.front().facet);
    }
  }
  for (Index& crack : crack_) crack = first_of(crack);
  find_order();
}

template void CrackGraph::build<2>(std::span<const CrackFacet<2>>);
template void CrackGraph::build<3>(std::span<const CrackFacet<3>>);

/// From an end of every crack on, by the number of joints between: of a facet as far as can be from
/// the first, found by going once from any.
void CrackGraph::find_order() {
  std::vector<std::vector<Index>> next(area_.size());
  for (std::size_t k = 0; k < joint_count(); ++k) {
    for (const Branch& a : joint(k)) {
      for (const Branch& b : joint(k)) {
        if (a.facet != b.facet) next[a.facet].push_back(b.facet);
      }
    }
  }
  std::vector<bool> is_met(area_.size(), false);
  const auto walk = [&](Index first) {
    std::vector<Index> met{first};
    is_met[first] = true;
    for (std::size_t k = 0; k < met.size(); ++k) {
      for (const Index facet : next[met[k]]) {
        if (is_met[facet]) continue;
        is_met[facet] = true;
        met.push_back(facet);
      }
    }
    return met;
  };
  for (Index f = 0; f < facet_count(); ++f) {
    if (is_met[f]) continue;
    const std::vector<Index> crack = walk(f);
    for (const Index facet : crack) is_met[facet] = false;
    const std::vector<Index> ordered = walk(crack.back());
    order_.insert(order_.end(), ordered.begin(), ordered.end());
  }
}

}  // namespace perifrac
