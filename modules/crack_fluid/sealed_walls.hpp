#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/geometry/bond_state.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

/// Facets whose walls nothing passes through, such as those of a cased hole.
class SealedWalls {
 public:
  /// Sealed is what lies in one of these boxes with its middle.
  explicit SealedWalls(std::vector<Region<2>> boxes = {}) : boxes_(std::move(boxes)) {}

  /// Follows the facets, which are only added.
  void match(const BondState<2>& bonds) {
    const PointSet& facets = bonds.facet_points();
    if (boxes_.empty()) return;
    for (std::size_t f = sealed_.size(); f < facets.count; ++f) {
      const Vector<2> middle = {facets.position[0][f], facets.position[1][f]};
      sealed_.push_back(
          std::ranges::any_of(boxes_, [&](const Region<2>& box) { return box.contains(middle); }));
    }
  }

  bool contain(Index facet) const { return !boxes_.empty() && sealed_[facet]; }

 private:
  std::vector<Region<2>> boxes_;
  std::vector<bool> sealed_;  ///< by facet
};

}  // namespace perifrac
