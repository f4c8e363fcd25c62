#include "core/bonds/bond_traversal.hpp"

#include <atomic>

#include <gtest/gtest.h>

#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

TEST(BondTraversal, SumsOverEveryBondOnce) {
  const auto body = test::box_body<2>({6, 5}, 0.5, Cloud::jittered);
  const FaceSet mirrored = 0b0110;
  const auto family = body->family(mirrored);
  const auto nodes = test::all_images<2>(body->points(), body->faces(), mirrored);
  for (Index i = 0; i < family->point_count; ++i) {
    const auto sum = sum_over_bonds<3>(*family, i, [&](Index j, const Vector<2>& xi, double w) {
      return std::array<double, 3>{w, w * xi[0] * xi[1], family->position[0][j]};
    });
    std::array<double, 3> expected{};
    const Vector<2> x = body->points().at(i);
    for (const auto& node : nodes) {
      const double r = test::distance<2>(x, node.x);
      if (r == 0.0 || r > body->horizon()) continue;
      const double s = r / (0.4 * body->horizon());
      const double w = std::exp(-s * s) * body->points().volume[node.source];
      expected[0] += w;
      expected[1] += w * (node.x[0] - x[0]) * (node.x[1] - x[1]);
      expected[2] += node.x[0];
    }
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(sum[k], expected[k], 1e-13 * (1 + std::abs(expected[k])));
  }
}

TEST(BondTraversal, VisitsEveryPointOnce) {
  for (const Index count : {1, 1999, points_worth_threads, 2 * points_worth_threads + 1}) {
    std::vector<std::atomic<int>> visits(count);
    for_each_point(count, [&](Index i) { ++visits[i]; });
    for (const auto& n : visits) ASSERT_EQ(n, 1);
  }
}

}  // namespace
}  // namespace perifrac
