#pragma once

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "core/bonds/crack_facet.hpp"

namespace perifrac {

/// The grid that a plane crack in 3D grows on: squares of its first facet's shape, numbered along
/// its two sides. Lengths are in sides of a square.
class CrackPlane {
 public:
  using Cell = std::array<int, 2>;

  /// `is_rock` says of a square that is no facet whether it lies in the body.
  CrackPlane(const CrackFacet<3>& first, std::function<bool(const CrackFacet<3>&)> is_rock);

  /// Which square the facet is; none: it is not of this grid.
  std::optional<Cell> cell_of(const CrackFacet<3>& facet) const;
  /// Its corners are those of facets around it, to the bit.
  CrackFacet<3> facet(const Cell& cell) const;
  void add(const CrackFacet<3>& facet, Index number);

  const std::map<Cell, Index>& facets() const { return facets_; }
  /// Rock beside a facet.
  std::vector<Cell> ahead() const;

  /// How far a facet lies behind the crack's front, or ahead of it (negative): the front of squares
  /// is evened out over some sides.
  double behind_front(const Cell& cell) const;
  /// That of a round crack with as much area to its front.
  double radius() const;

 private:
  bool is_rock(const Cell& cell) const;

  Vector<3> origin_;
  std::array<Vector<3>, 2> side_;
  std::function<bool(const CrackFacet<3>&)> asks_rock_;
  std::map<Cell, Index> facets_;
  std::map<Cell, Vector<3>> corner_;  ///< by its number along both sides
  mutable std::map<Cell, bool> is_rock_;
  mutable std::map<Cell, double> behind_front_;  ///< as far as it was asked for
};

}  // namespace perifrac
