#pragma once

#include <array>
#include <memory>
#include <vector>

#include "core/base/point_set.hpp"

namespace perifrac {

/// A copy of a point set that stays when its module moves on, inserts points or is taken back:
/// values read from a port are mapped from the points they were read on.
class FrozenPoints {
 public:
  explicit FrozenPoints(const PointSet& points);
  FrozenPoints(const FrozenPoints&) = delete;
  FrozenPoints& operator=(const FrozenPoints&) = delete;

  const PointSet& set() const { return set_; }

 private:
  std::array<std::vector<double>, 3> position_;
  PointSet set_;
};

using SharedPoints = std::shared_ptr<const FrozenPoints>;

/// A frozen copy of `points`: `last` itself where its version still holds, so that bodies whose
/// points do not change are copied once.
SharedPoints freeze(const PointSet& points, SharedPoints last);

}  // namespace perifrac
