#include "core/body/body.hpp"

#include <gtest/gtest.h>

#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

TEST(Body, SharesOneFamilyBetweenUsersOfTheSameFaces) {
  const auto body = test::box_body<2>({8, 8}, 1.0);
  const auto first = body->family(0b0101);
  EXPECT_EQ(body->family(0b0101), first);
  EXPECT_NE(body->family(0b0001), first);
  const auto left = body->family(0b0001);
  EXPECT_GT(left->ghost_count(), 0);
  for (const FaceSet faces : left->ghost_faces) EXPECT_EQ(faces, 0b0001u);
}

TEST(Body, FindsTheNearestPoint) {
  const auto body = test::box_body<3>({4, 5, 6}, 0.5);
  const Points<3>& points = body->points();
  for (const Vector<3> x : {Vector<3>{0.3, 1.2, 2.9}, {-5.0, 1.1, 9.0}, {1.9, 2.4, 0.1}}) {
    const Index nearest = body->nearest_point(x);
    double found = 0.0, least = INFINITY;
    for (Index i = 0; i < points.size(); ++i) {
      double r2 = 0.0;
      for (int a = 0; a < 3; ++a) r2 += std::pow(points.position[a][i] - x[a], 2);
      least = std::min(least, r2);
      if (i == nearest) found = r2;
    }
    EXPECT_EQ(found, least);
  }
}

TEST(Body, TakesTheFirstOfTiedPoints) {
  for (const double spacing : {1.0, 0.1, 1.0 / 3.0}) {
    const auto body = test::box_body<2>({4, 4}, spacing);
    const Index nearest = body->nearest_point({2.0 * spacing, 2.0 * spacing});
    for (Index i = 0; i < nearest; ++i) {
      const Vector<2> x = body->points().at(i);
      EXPECT_GT(std::hypot(x[0] - 2.0 * spacing, x[1] - 2.0 * spacing), 0.75 * spacing);
    }
  }
}

TEST(Body, ShowsItsPointsAsAPointSet) {
  const auto body = test::box_body<3>({3, 4, 5}, 1.0);
  const PointSet& set = body->point_set();
  EXPECT_EQ(set.dimension, 3);
  EXPECT_EQ(set.count, 60u);
  for (int a = 0; a < 3; ++a) {
    EXPECT_EQ(set.position[a].data(), body->points().position[a].data());
  }
}

}  // namespace
}  // namespace perifrac
