#include "core/geometry/crack_cut.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// Of a facet's size: how far beyond its edge a bond still counts as cut, against rounding.
constexpr double edge_tolerance = 1e-9;

Vector<3> cross(const Vector<3>& a, const Vector<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <int D>
Vector<D> minus(const Vector<D>& a, const Vector<D>& b) {
  Vector<D> difference;
  for (int k = 0; k < D; ++k) difference[k] = a[k] - b[k];
  return difference;
}

template <int D>
double dot(const Vector<D>& a, const Vector<D>& b) {
  double sum = 0.0;
  for (int k = 0; k < D; ++k) sum += a[k] * b[k];
  return sum;
}

/// Normal of the facet, of the length (2D) or twice the area (3D).
Vector<2> normal_of(const CrackFacet<2>& facet) {
  const Vector<2> along = minus<2>(facet[1], facet[0]);
  return {-along[1], along[0]};
}
Vector<3> normal_of(const CrackFacet<3>& facet) {
  return cross(minus<3>(facet[1], facet[0]), minus<3>(facet[2], facet[0]));
}

/// A point of the facet's plane lies within its edges.
bool contains(const CrackFacet<2>& facet, const Vector<2>& x) {
  const Vector<2> along = minus<2>(facet[1], facet[0]);
  const double t = dot<2>(minus<2>(x, facet[0]), along) / dot<2>(along, along);
  return t >= -edge_tolerance && t <= 1.0 + edge_tolerance;
}
bool contains(const CrackFacet<3>& facet, const Vector<3>& x) {
  const Vector<3> normal = normal_of(facet);
  const double size = dot<3>(normal, normal);
  for (int k = 0; k < 3; ++k) {
    const Vector<3> edge = minus<3>(facet[(k + 1) % 3], facet[k]);
    if (dot<3>(cross(edge, minus<3>(x, facet[k])), normal) < -edge_tolerance * size) return false;
  }
  return true;
}

}  // namespace

template <int D>
std::vector<std::pair<Index, Index>> bonds_cut_by(const CrackFacet<D>& facet,
                                                  const Family<D>& family) {
  const Vector<D> normal = normal_of(facet);
  const double rounding = edge_tolerance * dot<D>(normal, normal);
  std::vector<std::pair<Index, Index>> cut;
  const auto place = [&](Index i) {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = family.position[a][i];
    return x;
  };
  const auto height = [&](const Vector<D>& x) {
    const double h = dot<D>(minus<D>(x, facet[0]), normal);
    return std::abs(h) <= rounding ? rounding : h;
  };
  for (Index i = 0; i < family.point_count; ++i) {
    const Vector<D> x = place(i);
    const double below = height(x);
    for (Index bond = family.offset[i]; bond < family.offset[i + 1]; ++bond) {
      const Index j = family.other[bond];
      if (j <= i || j >= family.point_count || family.weight[bond] == 0.0) continue;
      const Vector<D> y = place(j);
      const double above = height(y);
      if (below * above > 0.0) continue;
      Vector<D> crossing;
      for (int a = 0; a < D; ++a) crossing[a] = x[a] + below / (below - above) * (y[a] - x[a]);
      if (contains(facet, crossing)) cut.emplace_back(i, j);
    }
  }
  return cut;
}

template std::vector<std::pair<Index, Index>> bonds_cut_by<2>(const CrackFacet<2>&,
                                                              const Family<2>&);
template std::vector<std::pair<Index, Index>> bonds_cut_by<3>(const CrackFacet<3>&,
                                                              const Family<3>&);

}  // namespace perifrac
