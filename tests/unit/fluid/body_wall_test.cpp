#include "modules/fluid/walls/body_wall.hpp"

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

/// Walls of a notch: half a spacing behind its surface lies the first row, normal into the notch.
TEST(BodyWall, HasTheWallsOfCutouts) {
  const Region<2> notch{"notch", {8.0, 10.0}, {12.0, 20.0}};
  const Points<2> lattice = box_lattice<2>({20, 20}, 1.0);
  Points<2> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    if (!notch.contains(lattice.at(i))) points.add(lattice.at(i), 1.0);
  }
  std::vector<Face> faces = {
      {"left", 0, -1, 0.0}, {"right", 0, 1, 20.0}, {"bottom", 1, -1, 0.0}, {"top", 1, 1, 20.0}};
  Body<2> body(points, faces, 1.0, 2.5, InfluenceFunction::gaussian);
  body.set_cutouts({notch});
  WallCloud<2> cloud;
  add_body<2>(body, false, 1.0, 2.5, {}, cloud);
  const auto expect = [&](const Vector<2>& x, const Vector<2>& normal, double depth) {
    for (Index w = 0; w < cloud.size(); ++w) {
      if (cloud.at(w) != x) continue;
      EXPECT_EQ(cloud.normal[0][w], normal[0]) << x[0] << ", " << x[1];
      EXPECT_EQ(cloud.normal[1][w], normal[1]) << x[0] << ", " << x[1];
      EXPECT_EQ(cloud.depth[w], depth) << x[0] << ", " << x[1];
      return;
    }
    FAIL() << "no wall at " << x[0] << ", " << x[1];
  };
  expect({7.5, 14.5}, {1.0, 0.0}, 0.5);
  expect({6.5, 14.5}, {1.0, 0.0}, 1.5);
  expect({12.5, 14.5}, {-1.0, 0.0}, 0.5);
  expect({9.5, 9.5}, {0.0, 1.0}, 0.5);
  expect({9.5, 7.5}, {0.0, 1.0}, 2.5);
  expect({3.5, 19.5}, {0.0, 1.0}, 0.5);  // the body's own top, as before
  for (Index w = 0; w < cloud.size(); ++w) {
    EXPECT_FALSE(cloud.at(w)[0] == 4.5 && cloud.at(w)[1] == 14.5);  // deeper than a horizon
  }
}

}  // namespace
}  // namespace perifrac
