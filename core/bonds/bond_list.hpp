#pragma once

#include <vector>

#include "core/bonds/family.hpp"

namespace perifrac {

/// Bonds as they are found, one point after the other, for a family to keep.
template <int D>
class BondList {
 public:
  /// Goes on to the next point.
  void begin_point(Index i) {
    point_ = i;
    steps_.clear();
    weights_.clear();
  }
  /// Adds a bond of that point, behind those to lower numbers.
  void add(Index other, double weight) {
    steps_.push_back(other - point_);
    weights_.push_back(weight);
  }
  /// That were all of the point.
  void end_point() {
    all_steps_.add(steps_);
    all_weights_.add(weights_);
  }

  /// Instead of those that the family has.
  void give_to(Family<D>& family) {
    family.steps = all_steps_.take();
    family.weight = all_weights_.take();
  }

 private:
  Index point_ = 0;
  std::vector<Index> steps_;     ///< of the point
  std::vector<double> weights_;  ///< of the point
  SharedRowList<Index> all_steps_;
  BondWeightList all_weights_;
};

}  // namespace perifrac
