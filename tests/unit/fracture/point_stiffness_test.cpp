#include "core/operators/point_stiffness.hpp"

#include <gtest/gtest.h>

#include "tests/unit/fracture/breaking_solid.hpp"

namespace perifrac {
namespace {

/// What all points add makes the whole stiffness: beside mirrored faces, on a cloud, and where
/// bonds broke until families are thin.
template <int D>
void expect_sum(test::Cloud cloud, double limit, test::Rock rock) {
  const auto body = test::box_body<D>(test::cube<D>(D == 2 ? 8 : 4), 0.5, cloud);
  SolidBoundary<D> boundary(*body);
  boundary.fixed(0, {});
  boundary.roller(3, 0.0);
  const test::Breakable<D> parts(*body, boundary, {test::lambda, test::mu}, rock);
  CriticalStretch<D> breaking(parts.family, parts.elastic, body->claim_bond_state(), {}, limit);
  breaking.cut_seeds();
  const std::vector<double> u = test::random_values(parts.elastic->size());
  std::vector<double> force(u.size()), theta(body->points().size());
  parts.elastic->apply(u, {}, force, theta);
  breaking.breaks(u);

  const Eigen::MatrixXd whole = parts.elastic->assemble();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(whole.rows(), whole.cols());
  Index thin = 0;
  for (Index i = 0; i < body->points().size(); ++i) {
    const PointStiffness part = parts.elastic->point_stiffness(i);
    for (std::size_t a = 0; a < part.unknowns.size(); ++a) {
      for (std::size_t b = 0; b < part.unknowns.size(); ++b) {
        sum(part.unknowns[a], part.unknowns[b]) += part.matrix(a, b);
      }
    }
    thin += is_thin(*parts.family, i);
  }
  EXPECT_EQ(thin > 0, limit == 0.0);
  EXPECT_LE((sum - whole).cwiseAbs().maxCoeff(), 1e-12 * whole.cwiseAbs().maxCoeff());
  parts.elastic->apply(u, {}, force, theta);
  EXPECT_LE((whole * test::as_eigen(u) - test::as_eigen(force)).cwiseAbs().maxCoeff(),
            1e-12 * test::largest(force));
  double energy = 0.0;
  const auto deformed = parts.elastic->deform(u);
  for (Index i = 0; i < body->points().size(); ++i) energy += deformed.energy(i);
  EXPECT_NEAR(energy, parts.elastic->energy(u, force), 1e-12 * energy);
}

TEST(PointStiffness, AddsUpToTheWhole) {
  for (const test::Rock rock : test::rocks) {
    expect_sum<2>(test::Cloud::lattice, INFINITY, rock);
    expect_sum<2>(test::Cloud::jittered, INFINITY, rock);
    expect_sum<3>(test::Cloud::lattice, INFINITY, rock);
  }
}

TEST(PointStiffness, AddsUpToTheWholeWhereFamiliesAreThin) {
  for (const test::Rock rock : test::rocks) {
    expect_sum<2>(test::Cloud::lattice, 0.0, rock);
    expect_sum<3>(test::Cloud::lattice, 0.0, rock);
  }
}

}  // namespace
}  // namespace perifrac
