#include "core/body/bonded_layer.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

template <int D>
std::set<Vector<D>> places(const Points<D>& points) {
  std::set<Vector<D>> all;
  for (Index i = 0; i < points.size(); ++i) all.insert(points.at(i));
  return all;
}

TEST(BondedLayer, IsOneHorizonInWholeSpacings) {
  for (const double spacing : {1.0, 0.1, 1.0 / 3.0, 7e-4}) {
    EXPECT_EQ(layer_rows(3.0 * spacing, spacing), 3);
    EXPECT_EQ(layer_rows(2.5 * spacing, spacing), 3);
    EXPECT_EQ(layer_rows(2.01 * spacing, spacing), 3);
  }
}

/// Layers are what the lattice has beyond the faces' planes, corners filled and in both layers.
template <int D>
void expect_rows_behind_the_faces(const std::array<int, D>& counts) {
  const int low = 0, high = 2 * D - 1;
  const auto body = test::layered_body<D>(counts, 1.0, face_bit(low) | face_bit(high));
  const auto proper = test::box_body<D>(counts, 1.0);
  Index beside = 1, between = 1;  // points of a row behind `low`, corner included, and of a corner
  for (int a = 1; a < D; ++a) beside *= counts[a] + (a == D - 1 ? 3 : 0);
  for (int a = 1; a < D - 1; ++a) between *= counts[a];
  EXPECT_EQ(static_cast<Index>(body->layer(low).size()), 3 * beside);
  std::set<Index> layered(body->layer(low).begin(), body->layer(low).end());
  Index corner = 0;
  for (const Index i : body->layer(high)) corner += !layered.insert(i).second;
  EXPECT_EQ(corner, 9 * between);
  for (const Index i : body->layer(low)) EXPECT_LT(body->points().position[0][i], 0.0);
  for (const Index i : body->layer(high)) {
    EXPECT_GT(body->points().position[D - 1][i], counts[D - 1]);
  }
  Points<D> rest;
  for (Index i = 0; i < body->points().size(); ++i) {
    if (!layered.contains(i)) rest.add(body->points().at(i), 1.0);
  }
  EXPECT_EQ(places(rest), places(proper->points()));
  for (int f = 1; f < 2 * D - 1; ++f) EXPECT_TRUE(body->layer(f).empty());
  EXPECT_EQ(body->thickness(low), counts[0] + 3.0);
  EXPECT_EQ(body->thickness(low, face_bit(low)), counts[0]);
  EXPECT_EQ(body->thickness(high), counts[D - 1] + 3.0);
}

TEST(BondedLayer, FillsRowsBehindItsFacesCornersIncluded) {
  expect_rows_behind_the_faces<2>({4, 5});
  expect_rows_behind_the_faces<3>({4, 3, 5});
}

TEST(BondedLayer, TakesNoProbesOfTheBody) {
  const auto body = test::layered_body<2>({4, 4}, 1.0, 0b0001);
  EXPECT_EQ(body->points().at(body->nearest_point({-2.4, 1.4})), (Vector<2>{0.5, 1.5}));
}

// Left of x = 0 a layer of three rows, mirrored below: the same bonds as in a longer box.
TEST(BondedLayer, IsMirroredAtTheFacesBesideIt) {
  const auto layered = test::layered_body<2>({8, 6}, 1.0, 0b0001)->family(0b0110);
  const auto longer = test::box_body<2>({11, 6}, 1.0)->family(0b0110);
  EXPECT_EQ(layered->steps, longer->steps);
  EXPECT_EQ(layered->weight, longer->weight);
  EXPECT_EQ(layered->ghost_source, longer->ghost_source);
}

TEST(BondedLayer, CannotBeMirroredItself) {
  EXPECT_THROW(test::layered_body<2>({8, 6}, 1.0, 0b0001)->family(0b0001), std::logic_error);
}

TEST(BondedLayer, CountsForTheThicknessOnlyWithItsBonds) {
  const auto body = test::layered_body<2>({8, 2}, 1.0, 0b1000);
  EXPECT_NO_THROW(body->family(0b0100));
  EXPECT_THROW(body->family(0b0100, 0b1000), BodyError);
}

TEST(BondedLayer, LosesItsBondsWhereAPhysicsLeavesItOut) {
  const auto body = test::layered_body<2>({6, 6}, 1.0, 0b0101);
  const auto family = body->family(0b0010, 0b0001);
  EXPECT_EQ(body->family(0b0010, 0b0001), family);
  EXPECT_NE(body->family(0b0010), family);
  for (const Index i : body->layer(0)) {
    EXPECT_EQ(family->bond_count(i), 0);
    for (Index j = 0; j < family->point_count; ++j) {
      EXPECT_EQ(std::ranges::count(family->steps[j], i - j), 0);
    }
    EXPECT_TRUE(std::ranges::find(family->ghost_source, i) == family->ghost_source.end());
  }
  for (const Index i : body->layer(2)) {
    if (body->points().position[0][i] > 0.0) {
      EXPECT_GT(family->bond_count(i), 0);
    }
  }
}

}  // namespace
}  // namespace perifrac
