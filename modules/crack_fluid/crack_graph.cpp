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
}

}  // namespace perifrac
