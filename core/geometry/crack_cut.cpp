#include "core/geometry/crack_cut.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

namespace {

/// Of a facet's size: how far beyond its edge a bond still counts as cut, against rounding.
constexpr double edge_tolerance = 1e-9;

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

/// A point of the facet's plane lies within its edges.
template <int D>
bool contains(const CrackFacet<D>& facet, const Vector<D>& x) {
  return std::ranges::all_of(place_within<D>(facet, x), [](double share) {
    return share >= -edge_tolerance && share <= 1.0 + edge_tolerance;
  });
}

}  // namespace

template <int D>
std::vector<std::pair<Index, Index>> bonds_cut_by(const CrackFacet<D>& facet,
                                                  const Family<D>& family) {
  const Vector<D> normal = frame<D>(facet)[0];
  const double size = std::pow(area<D>(facet), 1.0 / (D - 1));
  const double rounding = edge_tolerance * size;
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
      if (contains<D>(facet, crossing)) cut.emplace_back(i, j);
    }
  }
  return cut;
}

template std::vector<std::pair<Index, Index>> bonds_cut_by<2>(const CrackFacet<2>&,
                                                              const Family<2>&);
template std::vector<std::pair<Index, Index>> bonds_cut_by<3>(const CrackFacet<3>&,
                                                              const Family<3>&);

}  // namespace perifrac
