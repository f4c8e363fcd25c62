#include "core/body/plane_crack_seeds.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/body/crack_seeds.hpp"
#include "tests/unit/config/scene_fixture.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

/// In a cube of 20 points a side, at spacing 1.
std::vector<CrackFacet<3>> read_plane(const std::string& crack) {
  KeyTable keys = crack_seed_keys();
  keys.push_back({.path = "dimension", .type = KeyType::integer, .meaning = "Of space."});
  const SceneFile file("dimension: 3\ncracks: [" + crack + "]\n");
  static const auto body = test::box_body<3>({20, 20, 20}, 1.0);
  return read_plane_crack(read_scene(file.path(), {}, {{"", "", keys}}), 0, *body);
}

double total_area(const std::vector<CrackFacet<3>>& facets) {
  double sum = 0.0;
  for (const auto& facet : facets) sum += area<3>(facet);
  return sum;
}

TEST(PlaneCrackSeeds, FillADisc) {
  for (const std::string normal : {"[0, 0, 1]", "[0, -2, 0]", "[1, 1, 0.5]"}) {
    const auto facets =
        read_plane("{name: a, centre: [10 m, 10 m, 10 m], normal: " + normal + ", radius: 6 m}");
    EXPECT_NEAR(total_area(facets), M_PI * 36.0, 0.03 * M_PI * 36.0) << normal;
    for (const auto& facet : facets) {
      EXPECT_NEAR(area<3>(facet), 1.0, 1e-12);
      const Vector<3> at = middle<3>(facet);
      EXPECT_LE(std::hypot(at[0] - 10.0, at[1] - 10.0, at[2] - 10.0), 6.0);
      EXPECT_EQ(std::abs(frame<3>(facet)[0][2]) > 0.999, normal == "[0, 0, 1]");
    }
  }
}

TEST(PlaneCrackSeeds, FillARectangle) {
  const auto facets =
      read_plane("{name: a, centre: [10 m, 10 m, 10 m], normal: [0, 0, 1], sides: [6 m, 4 m]}");
  EXPECT_EQ(facets.size(), 24u);
}

/// Of a disc about the edge between two faces a quarter is there.
TEST(PlaneCrackSeeds, EndWithTheBody) {
  const auto whole =
      read_plane("{name: a, centre: [10 m, 10 m, 10 m], normal: [0, 0, 1], radius: 5 m}");
  const auto quarter =
      read_plane("{name: a, centre: [0 m, 0 m, 10 m], normal: [0, 0, 1], radius: 5 m}");
  EXPECT_EQ(4 * quarter.size(), whole.size());
}

TEST(PlaneCrackSeeds, RefusesWhatIsNone) {
  const std::string at = "centre: [10 m, 10 m, 10 m], ", up = "normal: [0, 0, 1], ";
  EXPECT_NO_THROW(read_plane("{name: a, " + at + up + "radius: 3 m}"));
  EXPECT_THROW(read_plane("{name: a, " + at + up + "radius: 0.5 m}"), InputError);
  EXPECT_THROW(read_plane("{name: a, " + at + up + "radius: 3 m, sides: [3 m, 3 m]}"), InputError);
  EXPECT_THROW(read_plane("{name: a, " + at + "normal: [0, 0, 0], radius: 3 m}"), InputError);
  EXPECT_THROW(read_plane("{name: a, " + at + "radius: 3 m}"), InputError);
  EXPECT_THROW(read_plane("{name: a, " + up + "radius: 3 m}"), InputError);
  EXPECT_THROW(read_plane("{name: a, " + at + up + "sides: [3 m]}"), InputError);
  EXPECT_THROW(read_plane("{name: a, path: [0 m, 0 m, 3 m, 0 m]}"), InputError);
  EXPECT_THROW(read_plane("{name: a, centre: [90 m, 0 m, 0 m], " + up + "radius: 3 m}"),
               InputError);
}

}  // namespace
}  // namespace perifrac
