#include "core/bonds/bond_traversal.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

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

/// Families of any size, smaller than a packet and empty ones among them, of clouds and of
/// lattices, whose weights are packed.
template <int D>
void expect_rows_as_columns(const Family<D>& family) {
  constexpr int used = D + 1, count = D + 2;
  const auto nodes = static_cast<std::size_t>(family.node_count());
  std::vector<double> field, other_field(nodes, 7.0);
  for (std::size_t i = 0; i < nodes; ++i) field.push_back(std::sin(3.0 * static_cast<double>(i)));
  NodeColumns<count> columns;
  std::array<std::span<const double>, count> blocks;
  for (int a = 0; a < D; ++a) blocks[a] = family.position[a];
  blocks[D] = field;
  blocks[D + 1] = other_field;
  for (int k = 0; k < count; ++k) columns.column[k] = blocks[k].data();
  NeighbourRows<count> rows;
  rows.set(blocks);
  std::size_t fewest = nodes;
  for (Index i = 0; i < family.point_count; ++i) {
    const auto term = [&](auto, const auto& other, const auto& xi, const auto& w) {
      // What is surplus may be divided by, too.
      return std::array{w * xi[0] / (xi[0] * xi[0] + xi[1] * xi[1]), w * other[D] * xi[1]};
    };
    const auto by_columns = sum_over_bonds<2, used>(family, i, columns, term);
    const auto by_rows = sum_over_bonds<2, used>(family, i, rows, term);
    double size = 0.0;
    for (const auto& bond : family.bonds(i)) size += bond.weight;
    for (int k = 0; k < 2; ++k) EXPECT_NEAR(by_rows[k], by_columns[k], 1e-13 * size) << i;
    fewest = std::min(fewest, static_cast<std::size_t>(family.bond_count(i)));
  }
  EXPECT_LE(fewest, 8u);
}

TEST(BondTraversal, SumsByRowsOfValuesAsByColumns) {
  expect_rows_as_columns(*test::box_body<2>({6, 5}, 0.5, Cloud::jittered)->family(0b0110));
  expect_rows_as_columns(*test::box_body<2>({2, 2}, 0.5, Cloud::jittered)->family(0));
  expect_rows_as_columns(*test::box_body<3>({2, 2, 2}, 0.5, Cloud::jittered)->family(0));
  expect_rows_as_columns(*test::box_body<2>({7, 3}, 0.5, Cloud::lattice)->family(0b0010));
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
