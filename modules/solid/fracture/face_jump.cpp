#include "modules/solid/fracture/face_jump.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "core/base/small_vector.hpp"
#include "core/bonds/crack_cut.hpp"

namespace perifrac {

namespace {

struct Crossing {
  Index below;
  Index above;
  double length;  ///< [m]
  double weight;
};

}  // namespace

template <int D>
FaceJump<D> face_jump(const CrackFacet<D>& facet, const Family<D>& family, double spacing,
                      double longest) {
  FaceJump<D> jump;
  const auto axes = frame<D>(facet);
  jump.normal = axes[0];
  std::copy(axes.begin() + 1, axes.end(), jump.tangents.begin());
  jump.area = area<D>(facet);

  std::vector<Crossing> crossings;
  double shortest = INFINITY;
  for (const auto& [i, j] : bonds_cut_by<D>(facet, family, longest)) {
    const Vector<D> x = vector_at(family.position, i), xi = vector_at(family.position, j) - x;
    const double across = dot(jump.normal, xi), to_i = dot(jump.normal, x - facet[0]);
    const Vector<D> at = x - to_i / across * xi;
    const double length = norm(xi);
    const double steep = across / length;
    double weight = steep * steep;
    for (const double t : place_within<D>(facet, at)) {
      if (t < 1e-6 || t > 1.0 - 1e-6) weight *= 0.5;
    }
    crossings.push_back({across > 0.0 ? i : j, across > 0.0 ? j : i, length, weight});
    shortest = std::min(shortest, length);
  }
  const double reach = std::max(1.5 * spacing, 1.01 * shortest);
  double sum = 0.0;
  for (Crossing& crossing : crossings) {
    // As steep as the influence function of horizon 2.5 spacings, whatever the body's own.
    const double r = crossing.length / spacing;
    crossing.weight *= crossing.length <= reach ? std::exp(-r * r) : 0.0;
    sum += crossing.weight;
  }
  std::map<Index, double> coefficient;
  for (const Crossing& crossing : crossings) {
    if (crossing.weight == 0.0) continue;
    coefficient[crossing.above] += crossing.weight / sum;
    coefficient[crossing.below] -= crossing.weight / sum;
  }
  jump.reach = 0.0;
  for (const auto& [point, c] : coefficient) {
    jump.terms.push_back({point, c});
    jump.reach += c * dot(jump.normal, vector_at(family.position, point));
  }
  return jump;
}

template FaceJump<2> face_jump<2>(const CrackFacet<2>&, const Family<2>&, double, double);
template FaceJump<3> face_jump<3>(const CrackFacet<3>&, const Family<3>&, double, double);

}  // namespace perifrac
