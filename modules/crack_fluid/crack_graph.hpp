#pragma once

#include <span>
#include <vector>

#include "core/geometry/bond_state.hpp"

namespace perifrac {

/// How the facets of a 2D crack hang together: facets whose ends share a point, to the last bit,
/// meet at a joint.
class CrackGraph {
 public:
  /// The end of a facet that lies at a joint: 0 or 1.
  struct Branch {
    Index facet;
    int end;
  };

  CrackGraph() = default;
  explicit CrackGraph(std::span<const CrackFacet<2>> facets);

  Index facet_count() const { return static_cast<Index>(length_.size()); }
  double length(Index facet) const { return length_[facet]; }  ///< [m]
  /// The same number, below facet_count(), for facets that hang together.
  Index crack(Index facet) const { return crack_[facet]; }
  /// Where two or more facets meet.
  std::size_t joint_count() const { return offset_.size() - 1; }
  std::span<const Branch> joint(std::size_t k) const {
    return std::span(branches_).subspan(offset_[k], offset_[k + 1] - offset_[k]);
  }
  /// All facets, those that meet near each other (Cuthill & McKee).
  std::span<const Index> order() const { return order_; }

 private:
  void find_order();

  std::vector<double> length_;
  std::vector<Index> crack_;
  std::vector<Index> order_;
  std::vector<std::size_t> offset_{0};
  std::vector<Branch> branches_;
};

}  // namespace perifrac
