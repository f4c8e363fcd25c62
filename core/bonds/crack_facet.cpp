#include "core/bonds/crack_facet.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

Vector<3> normalised(const Vector<3>& a) { return a / norm(a); }

}  // namespace

template <>
std::array<Vector<2>, 2> frame<2>(const CrackFacet<2>& facet) {
  const Vector<2> along = facet[1] - facet[0];
  const Vector<2> tangent = along / std::hypot(along[0], along[1]);
  return {perpendicular(tangent), tangent};
}

template <>
std::array<Vector<3>, 3> frame<3>(const CrackFacet<3>& facet) {
  const Vector<3> along = facet[1] - facet[0];
  const Vector<3> normal = normalised(cross(along, facet[3] - facet[0]));
  const Vector<3> tangent = normalised(along);
  return {normal, tangent, cross(normal, tangent)};
}

template <>
double area<2>(const CrackFacet<2>& facet) {
  const Vector<2> along = facet[1] - facet[0];
  return std::hypot(along[0], along[1]);
}

template <>
double area<3>(const CrackFacet<3>& facet) {
  return norm(cross(facet[1] - facet[0], facet[3] - facet[0]));
}

template <>
std::array<double, 1> place_within<2>(const CrackFacet<2>& facet, const Vector<2>& x) {
  const Vector<2> along = facet[1] - facet[0];
  return {dot(x - facet[0], along) / squared_norm(along)};
}

template <>
std::array<double, 2> place_within<3>(const CrackFacet<3>& facet, const Vector<3>& x) {
  const Vector<3> one = facet[1] - facet[0], other = facet[3] - facet[0], from = x - facet[0];
  const Vector<3> normal = cross(one, other);
  const double size = squared_norm(normal);
  return {dot(cross(from, other), normal) / size, dot(cross(one, from), normal) / size};
}

template <>
std::array<FacetSide<2>, 2> sides<2>(const CrackFacet<2>& facet) {
  return {{{facet[0]}, {facet[1]}}};
}

template <>
std::array<FacetSide<3>, 4> sides<3>(const CrackFacet<3>& facet) {
  std::array<FacetSide<3>, 4> ends;
  for (int k = 0; k < 4; ++k) {
    ends[k] = {facet[k], facet[(k + 1) % 4]};
    std::ranges::sort(ends[k]);
  }
  return ends;
}

}  // namespace perifrac
