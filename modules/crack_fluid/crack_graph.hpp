#pragma once

#include <span>
#include <vector>

#include "core/bonds/bond_state.hpp"

namespace perifrac {

/// How the facets of a crack hang together: those that have a side (sides() of crack_facet.hpp; in
/// 2D an end) in common, to the last bit, meet at a joint.
class CrackGraph {
 public:
  /// The side of a facet that lies at a joint.
  struct Branch {
    Index facet;
    int side;
    double width = 1.0;  ///< of the side [m]; in 2D, per metre, 1
  };

  CrackGraph() = default;
  explicit CrackGraph(std::span<const CrackFacet<2>> facets) { build<2>(facets); }
  explicit CrackGraph(std::span<const CrackFacet<3>> facets) { build<3>(facets); }

  Index facet_count() const { return static_cast<Index>(area_.size()); }
  double area(Index facet) const { return area_[facet]; }  ///< [m^2]; in 2D its length
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
  template <int D>
  void build(std::span<const CrackFacet<D>> facets);
  void find_order();

  std::vector<double> area_;
  std::vector<Index> crack_;
  std::vector<Index> order_;
  std::vector<std::size_t> offset_{0};
  std::vector<Branch> branches_;
};

}  // namespace perifrac
