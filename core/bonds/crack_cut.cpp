#include "core/bonds/crack_cut.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// Of a facet's size: how far beyond its edge a bond still counts as cut, against rounding.
constexpr double edge_tolerance = 1e-7;

/// A point of the facet's plane lies within its edges.
template <int D>
bool holds(const CrackFacet<D>& facet, const Vector<D>& x) {
  return std::ranges::all_of(place_within<D>(facet, x), [](double share) {
    return share >= -edge_tolerance && share <= 1.0 + edge_tolerance;
  });
}

/// A facet, asked about many segments.
template <int D>
class Blade {
 public:
  explicit Blade(const CrackFacet<D>& facet)
      : facet_(facet),
        normal_(frame<D>(facet)[0]),
        rounding_(edge_tolerance * std::pow(area<D>(facet), 1.0 / (D - 1))) {}

  /// Above the facet's plane; in it as good as above [m].
  double height(const Vector<D>& x) const {
    const double h = dot(x - facet_[0], normal_);
    return std::abs(h) <= rounding_ ? rounding_ : h;
  }
  /// Of ends at these heights.
  bool cuts(const Vector<D>& x, double below, const Vector<D>& y, double above) const {
    if (below * above > 0.0) return false;
    return holds<D>(facet_, x + below / (below - above) * (y - x));
  }

 private:
  const CrackFacet<D>& facet_;
  Vector<D> normal_;
  double rounding_;
};

}  // namespace

template <int D>
bool is_cut(const CrackFacet<D>& facet, const Vector<D>& x, const Vector<D>& y) {
  const Blade<D> blade(facet);
  return blade.cuts(x, blade.height(x), y, blade.height(y));
}

template <int D>
std::vector<std::pair<Index, Index>> bonds_cut_by(const CrackFacet<D>& facet,
                                                  const Family<D>& family, double reach) {
  const Blade<D> blade(facet);
  const Vector<D> centre = middle<D>(facet);
  const double far = 1.001 * (norm(facet[0] - centre) + reach);
  std::vector<std::pair<Index, Index>> cut;
  for (Index i = 0; i < family.point_count; ++i) {
    const Vector<D> x = vector_at(family.position, i);
    if (squared_norm(x - centre) > far * far) continue;
    const double below = blade.height(x);
    for (const auto& [j, weight] : family.bonds(i)) {
      if (j <= i || j >= family.point_count || weight == 0.0) continue;
      const Vector<D> y = vector_at(family.position, j);
      if (blade.cuts(x, below, y, blade.height(y))) cut.emplace_back(i, j);
    }
  }
  return cut;
}

template bool is_cut<2>(const CrackFacet<2>&, const Vector<2>&, const Vector<2>&);
template bool is_cut<3>(const CrackFacet<3>&, const Vector<3>&, const Vector<3>&);
template std::vector<std::pair<Index, Index>> bonds_cut_by<2>(const CrackFacet<2>&,
                                                              const Family<2>&, double);
template std::vector<std::pair<Index, Index>> bonds_cut_by<3>(const CrackFacet<3>&,
                                                              const Family<3>&, double);

}  // namespace perifrac
