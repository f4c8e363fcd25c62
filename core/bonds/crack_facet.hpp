#pragma once

#include <array>

#include "core/base/points.hpp"

namespace perifrac {

/// A flat piece of a crack, about a spacing wide, by its corners: the ends of a segment in 2D, in
/// 3D those of a parallelogram, going round.
template <int D>
using CrackFacet = std::array<Vector<D>, 2 * (D - 1)>;

/// Its middle [m].
template <int D>
Vector<D> middle(const CrackFacet<D>& facet) {
  Vector<D> x;
  for (int a = 0; a < D; ++a) x[a] = 0.5 * (facet[0][a] + facet[D - 1][a]);
  return x;
}

/// Its normal and then what spans its plane, all of unit length.
template <int D>
std::array<Vector<D>, D> frame(const CrackFacet<D>& facet);

/// [m^2]; in 2D, per metre, its length.
template <int D>
double area(const CrackFacet<D>& facet);

/// Where a point of its plane lies along its sides, 0 to 1 within it.
template <int D>
std::array<double, D - 1> place_within(const CrackFacet<D>& facet, const Vector<D>& x);
template <>
std::array<double, 1> place_within<2>(const CrackFacet<2>& facet, const Vector<2>& x);
template <>
std::array<double, 2> place_within<3>(const CrackFacet<3>& facet, const Vector<3>& x);

/// Where another facet may meet it: an end in 2D, a side by its two ends in 3D, in an order that is
/// the same from both facets.
template <int D>
using FacetSide = std::array<Vector<D>, D - 1>;
template <int D>
std::array<FacetSide<D>, 2 * (D - 1)> sides(const CrackFacet<D>& facet);

}  // namespace perifrac
