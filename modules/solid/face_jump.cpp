#include "modules/solid/face_jump.hpp"

#include <cmath>
#include <map>

#include "core/geometry/crack_cut.hpp"

namespace perifrac {

namespace {

struct Crossing {
  Index below;
  Index above;
  double length;  ///< [m]
  double weight;
};

}  // namespace

FaceJump face_jump(const CrackFacet<2>& facet, const Family<2>& family, double spacing) {
  FaceJump jump;
  const Vector<2> along = {facet[1][0] - facet[0][0], facet[1][1] - facet[0][1]};
  jump.length = std::hypot(along[0], along[1]);
  jump.tangent = {along[0] / jump.length, along[1] / jump.length};
  jump.normal = {-jump.tangent[1], jump.tangent[0]};

  std::vector<Crossing> crossings;
  double shortest = INFINITY;
  for (const auto& [i, j] : bonds_cut_by<2>(facet, family)) {
    const Vector<2> xi = {family.position[0][j] - family.position[0][i],
                          family.position[1][j] - family.position[1][i]};
    const double across = jump.normal[0] * xi[0] + jump.normal[1] * xi[1];
    const double to_i = jump.normal[0] * (family.position[0][i] - facet[0][0]) +
                        jump.normal[1] * (family.position[1][i] - facet[0][1]);
    const double s = -to_i / across;
    const double t = (jump.tangent[0] * (family.position[0][i] + s * xi[0] - facet[0][0]) +
                      jump.tangent[1] * (family.position[1][i] + s * xi[1] - facet[0][1])) /
                     jump.length;
    const bool at_end = t < 1e-6 || t > 1.0 - 1e-6;
    const double length = std::hypot(xi[0], xi[1]);
    const double steep = across / length;
    const double weight = (at_end ? 0.5 : 1.0) * steep * steep;
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
  for (const auto& [point, c] : coefficient) jump.terms.push_back({point, c});
  return jump;
}

}  // namespace perifrac
