#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "modules/solid/cracked_body.hpp"
#include "modules/solid/energy_release.hpp"
#include "modules/solid/solid_boundary.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac::test {

/// A free plate of nx * ny points at spacing 1, three of whose unknowns are pinned, so that loads
/// must balance; E' = 1.
struct CrackedPlate {
  std::shared_ptr<const Body<2>> body;
  std::shared_ptr<Family<2>> family;
  std::shared_ptr<BreakableElasticity<2>> elastic;
  BondState<2> bonds;
  SolidBoundary<2> boundary;
  Eigen::SparseMatrix<double> free;
  std::unique_ptr<CrackedBody> cracked;

  CrackedPlate(int nx, int ny, std::vector<CrackFacet<2>> seeds, double poisson = 0.25,
               Cloud cloud = Cloud::lattice)
      : body(box_body<2>({nx, ny}, 1.0, cloud)),
        family(std::make_shared<Family<2>>(*body->family(0))),
        boundary(*body) {
    const double shear = 0.5 * (1.0 - poisson);
    const IsotropicElasticity<2> law{2.0 * shear * poisson / (1.0 - 2.0 * poisson), shear};
    elastic = std::make_shared<LinearExactElasticity<2, IsotropicElasticity<2>>>(
        LinearExactOperator<2, IsotropicElasticity<2>>(family, boundary.mirror_condition(*family),
                                                       law));
    const Index points = family->point_count;
    const Index low = body->nearest_point({0.0, 0.0}), right = body->nearest_point({1.0 * nx, 0.0});
    free.resize(2 * points, 2 * points - 3);
    std::vector<Eigen::Triplet<double>> ones;
    int column = 0;
    for (Index k = 0; k < 2 * points; ++k) {
      if (k == low || k == points + low || k == points + right) continue;
      ones.emplace_back(k, column++, 1.0);
    }
    free.setFromTriplets(ones.begin(), ones.end());
    cracked = std::make_unique<CrackedBody>(family, 1.0, elastic, free, bonds, std::nullopt,
                                            std::move(seeds));
    cracked->start();
  }

  /// Facets of a straight crack of `count` spacings.
  static std::vector<CrackFacet<2>> line(Vector<2> from, Vector<2> direction, int count) {
    std::vector<CrackFacet<2>> facets;
    const double size = std::hypot(direction[0], direction[1]);
    const auto at = [&](int k) {
      return Vector<2>{from[0] + k * direction[0] / size, from[1] + k * direction[1] / size};
    };
    for (int k = 0; k < count; ++k) facets.push_back({at(k), at(k + 1)});
    return facets;
  }

  /// Load of uniform stresses at the faces.
  Eigen::VectorXd remote(double sx, double sy, double sxy) {
    SolidBoundary<2> loads(*body);
    loads.traction(0, {-sx, -sxy});
    loads.traction(1, {sx, sxy});
    loads.traction(2, {-sxy, -sy});
    loads.traction(3, {sxy, sy});
    const auto mirror = loads.mirror_condition(*family);
    return free.transpose() * loads.loads(mirror, elastic->gradient_matrix()).at(0.0);
  }
};

}  // namespace perifrac::test
