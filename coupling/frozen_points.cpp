#include "coupling/frozen_points.hpp"

namespace perifrac {

FrozenPoints::FrozenPoints(const PointSet& points) : set_(points) {
  for (std::size_t axis = 0; axis < position_.size(); ++axis) {
    position_[axis].assign(points.position[axis].begin(), points.position[axis].end());
    set_.position[axis] = position_[axis];
  }
}

SharedPoints freeze(const PointSet& points, SharedPoints last) {
  if (last && last->set().same_points(points)) return last;
  return std::make_shared<const FrozenPoints>(points);
}

}  // namespace perifrac
