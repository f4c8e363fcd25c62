#pragma once

#include <cstdint>
#include <span>

#include "core/bonds/bond_weights.hpp"

namespace perifrac {

/// The bonds of one point, in the order of their other ends: what Family::bonds() gives.
class PointBonds {
 public:
  struct Bond {
    Index other;    ///< the other end: a real point or a ghost
    double weight;  ///< omega(|xi|) V_other; 0: broken
  };

  PointBonds(Index point, std::span<const Index> steps, const BondWeights& weights)
      : point_(point), steps_(steps), weights_(&weights) {}

  Index count() const { return static_cast<Index>(steps_.size()); }
  Index other(Index k) const { return point_ + steps_[k]; }
  double weight(Index k) const { return (*weights_)(point_, k); }

  class Iterator {
   public:
    Iterator(const PointBonds& bonds, Index k) : bonds_(&bonds), k_(k) {}
    Bond operator*() const { return {bonds_->other(k_), bonds_->weight(k_)}; }
    Iterator& operator++() {
      ++k_;
      return *this;
    }
    bool operator==(const Iterator& other) const { return k_ == other.k_; }

   private:
    const PointBonds* bonds_;
    Index k_;
  };
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, count()}; }

 private:
  Index point_;
  std::span<const Index> steps_;
  const BondWeights* weights_;
};

}  // namespace perifrac
