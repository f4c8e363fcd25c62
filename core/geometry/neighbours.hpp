#pragma once

#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// Neighbours of moving points, found anew as they move (of a reference body: Family).
struct Neighbours {
  std::vector<Index> offset;  ///< neighbours of target i: offset[i] .. offset[i + 1]
  std::vector<Index> other;   ///< ascending for each target

  Index target_count() const { return static_cast<Index>(offset.size()) - 1; }
  Index count(Index target) const { return offset[target + 1] - offset[target]; }
};

}  // namespace perifrac
