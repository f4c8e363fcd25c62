#include <algorithm>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/solvers/symmetric_spectrum.hpp"
#include "core/time/spectral_radius.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/lps_elasticity.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

/// What the stable step makes of the stiffness, over the largest eigenvalue; free surfaces, corners
/// and disorder included.
template <int D>
void expect_bound_of_largest_eigenvalue(const Body<D>& body, ElasticOperator<D>& solid) {
  std::vector<double> mass;
  for (Index k = 0; k < solid.size(); ++k) {
    mass.push_back(body.points().volume[k % body.points().size()]);
  }
  int products = 0;
  const double bound = symmetric_spectral_radius(
      "u", 0.0, mass, [&](std::span<const double> v, std::span<double> product) {
        ++products;
        solid.apply(v, {}, product, {});
      });
  const Eigen::VectorXd root = test::as_eigen(mass).cwiseSqrt().cwiseInverse();
  const Eigen::MatrixXd stiffness =
      root.asDiagonal() * Eigen::MatrixXd(solid.assemble()) * root.asDiagonal();
  const double largest = symmetric_spectrum(stiffness).values.maxCoeff();
  EXPECT_LT(products, 10);
  EXPECT_GT(bound, largest);
  EXPECT_LT(bound, 1.1 * largest);
}

/// Two rocks, the stiffer one in the few points about the middle.
template <int D>
LawByRegion<IsotropicElasticity<D>> inclusion(const Body<D>& body, double contrast) {
  const Points<D>& points = body.points();
  LawByRegion<IsotropicElasticity<D>> law{{{1.0, 1.0}, {contrast, contrast}},
                                          std::vector<std::uint8_t>(points.size())};
  for (Index i = 0; i < points.size(); ++i) {
    bool inside = true;
    for (int a = 0; a < D; ++a) {
      const auto [low, high] = std::ranges::minmax(points.position[a]);
      inside &= std::abs(points.position[a][i] - 0.5 * (low + high)) < body.spacing();
    }
    law.law_of_point[i] = inside ? 1 : 0;
  }
  return law;
}

template <int D>
void expect_bounds(int count, double ratio) {
  using Law = LawByRegion<IsotropicElasticity<D>>;
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = test::box_body<D>(test::cube<D>(count), 0.3, cloud, ratio);
    const auto family = body->family(0);
    const MirrorCondition<D, D> mirror(*family);
    for (const double contrast : {1.0, 1.3, 100.0}) {
      SCOPED_TRACE(contrast);
      const Law law = inclusion<D>(*body, contrast);
      LinearExactElasticity<D, Law> exact(LinearExactOperator<D, Law>(family, mirror, law));
      expect_bound_of_largest_eigenvalue<D>(*body, exact);
      LpsElasticity<D> lps(family, mirror, law);
      expect_bound_of_largest_eigenvalue<D>(*body, lps);
    }
  }
}

TEST(StableStep, IsFoundInFewerThanTenForces) {
  expect_bounds<2>(16, 2.5);
  expect_bounds<3>(6, 2.0);
}

}  // namespace
}  // namespace perifrac
