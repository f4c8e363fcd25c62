#pragma once

#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Adds the points of the body that are not in its wall yet, for fluid that may come to any of
/// them. Inside a body there is no surface: they have no normal, and lie at no depth.
template <int D>
void add_inner_points(const Body<D>& body, bool slips, WallCloud<D>& cloud);

/// The published rule for damaged points of the body: each stands in for fluid with the part
/// 1 - damage of its volume (paper Eq 23), in the shape tensor and so in the force of Eq 22. What
/// the paper does not say and this does: a point that lost a bond has no surface any more, so that
/// of intact walls alone it is certain that no fluid crosses them.
template <int D>
class DamagedWalls {
 public:
  explicit DamagedWalls(WallCloud<D> intact) : intact_(std::move(intact)) {}

  /// Makes the cloud that of a body so damaged, one value for each of its points; false: it was.
  bool apply(std::span<const double> damage, WallCloud<D>& cloud);

 private:
  WallCloud<D> intact_;
  std::vector<double> damage_;
};

}  // namespace perifrac
