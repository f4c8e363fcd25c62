#pragma once

#include <algorithm>
#include <utility>
#include <vector>

#include "core/base/point_set.hpp"
#include "core/base/small_vector.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

/// Facets whose walls nothing passes through, such as those of a cased hole.
template <int D>
class SealedWalls {
 public:
  /// Sealed is what lies in one of these boxes with its middle.
  explicit SealedWalls(std::vector<Region<D>> boxes = {}) : boxes_(std::move(boxes)) {}

  /// Follows the facets, which are only added.
  void match(const PointSet& facets) {
    if (boxes_.empty()) return;
    for (std::size_t f = sealed_.size(); f < facets.count; ++f) {
      const Vector<D> middle = vector_at<D>(facets.position, f);
      sealed_.push_back(
          std::ranges::any_of(boxes_, [&](const Region<D>& box) { return box.contains(middle); }));
    }
  }

  bool contain(Index facet) const { return !boxes_.empty() && sealed_[facet]; }

 private:
  std::vector<Region<D>> boxes_;
  std::vector<bool> sealed_;  ///< by facet
};

}  // namespace perifrac
