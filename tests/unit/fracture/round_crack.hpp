#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "modules/solid/fracture/condensed_body.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac::test {

/// The square of a grid of spacing 1 at this height whose corner nearest to the origin is (i, j).
inline CrackFacet<3> square(int i, int j, double height) {
  const auto at = [&](int x, int y) {
    return Vector<3>{static_cast<double>(x), static_cast<double>(y), height};
  };
  return {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)};
}

/// The quarter of a block around a round crack, of n * n * 2n points at spacing 1 and with E' = 1;
/// the crack about its edge, half-way up, all other faces on rollers.
struct RoundCrack {
  static constexpr double poisson_ratio = 0.25, shear_modulus = 0.5 * (1.0 - poisson_ratio);

  int n;
  std::shared_ptr<const Body<3>> body;
  std::shared_ptr<Family<3>> family;
  std::shared_ptr<BreakableElasticity<3>> elastic;
  BondState<3> bonds;
  std::unique_ptr<CondensedBody<3>> cracked;

  RoundCrack(int count, const std::vector<CrackFacet<3>>& seeds, double horizon_ratio = 2.0,
             bool rollers = true)
      : n(count), body(box_body<3>({n, n, 2 * n}, 1.0, Cloud::lattice, horizon_ratio)) {
    SolidBoundary<3> boundary(*body);
    for (int face = 0; face < 6; ++face) {
      if (rollers || face % 2 == 0) boundary.roller(face, 0.0);
    }
    family = std::make_shared<Family<3>>(*body->family(boundary.mirrored()));
    const IsotropicElasticity<3> law{
        2.0 * shear_modulus * poisson_ratio / (1.0 - 2.0 * poisson_ratio), shear_modulus};
    const auto mirror = boundary.mirror_condition(*family);
    elastic = std::make_shared<LinearExactElasticity<3, IsotropicElasticity<3>>>(
        LinearExactOperator<3, IsotropicElasticity<3>>(family, mirror, law));
    cracked =
        std::make_unique<CondensedBody<3>>(family, 1.0, elastic, boundary.free_unknowns(mirror),
                                           bonds, std::optional<InitialStress<3>>{}, seeds);
    cracked->start();
  }

  double height() const { return n; }
  /// The squares that lie within this distance of the edge with their middle.
  static std::vector<CrackFacet<3>> disc(int n, double radius) {
    std::vector<CrackFacet<3>> facets;
    for (int i = 0; i < radius; ++i) {
      for (int j = 0; j < radius; ++j) {
        if (std::hypot(i + 0.5, j + 0.5) <= radius) facets.push_back(square(i, j, n));
      }
    }
    return facets;
  }
  /// Of a round crack with as many squares in its quarter.
  static double radius(std::size_t squares) {
    return std::sqrt(4.0 * static_cast<double>(squares) / M_PI);
  }
};

}  // namespace perifrac::test
