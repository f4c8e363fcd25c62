#include "modules/crack_fluid/crack_graph.hpp"

#include <cmath>
#include <map>
#include <numeric>

namespace perifrac {

CrackGraph::CrackGraph(std::span<const CrackFacet<2>> facets) {
  std::map<Vector<2>, std::vector<Branch>> at;
  for (std::size_t f = 0; f < facets.size(); ++f) {
    const auto& [a, b] = facets[f];
    length_.push_back(std::hypot(b[0] - a[0], b[1] - a[1]));
    for (int end = 0; end < 2; ++end) {
      at[facets[f][end]].push_back({static_cast<Index>(f), end});
    }
  }
  crack_.resize(length_.size());
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

/// From an end of every crack on, by the number of joints between: of a facet as far as can be from
/// the first, found by going once from any.
void CrackGraph::find_order() {
  std::vector<std::vector<Index>> next(length_.size());
  for (std::size_t k = 0; k < joint_count(); ++k) {
    for (const Branch& a : joint(k)) {
      for (const Branch& b : joint(k)) {
        if (a.facet != b.facet) next[a.facet].push_back(b.facet);
      }
    }
  }
  std::vector<bool> is_met(length_.size(), false);
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
