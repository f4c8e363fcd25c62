#include "app/references/comparison.hpp"

#include <gtest/gtest.h>

#include "app/simulation/simulation.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

/// Points of the layer may lie as near to the line as those of the body.
TEST(PointsAlong, ARowLiesInTheBodyBesideLayers) {
  const std::string rock = R"(
dimension: 2
body: {shape: box, size: [4 m, 6 m], spacing: 1 m}
solid: {type: rigid}
time: {end: 1 s}
)";
  for (const char* layered : {"", "left", "bottom", "top"}) {
    std::vector<std::string> overrides;
    if (*layered) overrides.push_back(std::string("body.boundary.") + layered + "=layer");
    const Section scene = read_scene_text(rock, overrides);
    const Simulation simulation = make_simulation(scene);
    const PointSet& points = simulation.points();
    const std::vector<Index> row = points_along(scene, points, 1, {0.0, 0.0});
    ASSERT_EQ(row.size(), 6u) << layered;
    for (std::size_t k = 0; k < row.size(); ++k) {
      EXPECT_DOUBLE_EQ(points.position[0][row[k]], 0.5) << layered;
      EXPECT_DOUBLE_EQ(points.position[1][row[k]], 0.5 + static_cast<double>(k)) << layered;
    }
  }
}

}  // namespace
}  // namespace perifrac
