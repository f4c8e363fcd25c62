#include "core/bonds/crack_facet.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

template <int D>
Vector<D> minus(const Vector<D>& a, const Vector<D>& b) {
  Vector<D> difference;
  for (int k = 0; k < D; ++k) difference[k] = a[k] - b[k];
  return difference;
}

Vector<3> cross(const Vector<3>& a, const Vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

double dot(const Vector<3>& a, const Vector<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vector<3> normalised(const Vector<3>& a) {
  const double size = std::sqrt(dot(a, a));
  return {a[0] / size, a[1] / size, a[2] / size};
}

}  // namespace

template <>
std::array<Vector<2>, 2> frame<2>(const CrackFacet<2>& facet) {
  const Vector<2> along = minus<2>(facet[1], facet[0]);
  const double length = std::hypot(along[0], along[1]);
  const Vector<2> tangent = {along[0] / length, along[1] / length};
  return {{{-tangent[1], tangent[0]}, tangent}};
}

template <>
std::array<Vector<3>, 3> frame<3>(const CrackFacet<3>& facet) {
  const Vector<3> along = minus<3>(facet[1], facet[0]);
  const Vector<3> normal = normalised(cross(along, minus<3>(facet[3], facet[0])));
  const Vector<3> tangent = normalised(along);
  return {normal, tangent, cross(normal, tangent)};
}

template <>
double area<2>(const CrackFacet<2>& facet) {
  return std::hypot(facet[1][0] - facet[0][0], facet[1][1] - facet[0][1]);
}

template <>
double area<3>(const CrackFacet<3>& facet) {
  const Vector<3> twice = cross(minus<3>(facet[1], facet[0]), minus<3>(facet[3], facet[0]));
  return std::sqrt(dot(twice, twice));
}

template <>
std::array<double, 1> place_within<2>(const CrackFacet<2>& facet, const Vector<2>& x) {
  const Vector<2> along = minus<2>(facet[1], facet[0]);
  const Vector<2> from = minus<2>(x, facet[0]);
  return {(from[0] * along[0] + from[1] * along[1]) / (along[0] * along[0] + along[1] * along[1])};
}

template <>
std::array<double, 2> place_within<3>(const CrackFacet<3>& facet, const Vector<3>& x) {
  const Vector<3> one = minus<3>(facet[1], facet[0]), other = minus<3>(facet[3], facet[0]);
  const Vector<3> from = minus<3>(x, facet[0]);
  const Vector<3> normal = cross(one, other);
  const double size = dot(normal, normal);
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
