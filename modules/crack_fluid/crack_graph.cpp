#include "modules/crack_fluid/crack_graph.hpp"

#include <cmath>
#include <map>

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
  for (const auto& [place, branches] : at) {
    if (branches.size() < 2) continue;
    branches_.insert(branches_.end(), branches.begin(), branches.end());
    offset_.push_back(branches_.size());
  }
}

}  // namespace perifrac
