#include "app/probes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

std::vector<std::string> columns(const std::string& scene_text, const std::string& field) {
  const Section scene = read_scene_text(
      scene_text, {"output.probes=[{name: here, at: [1 m, 1 m], field: " + field + "}]"});
  Simulation simulation = make_simulation(scene);
  simulation.manager->initialize(0.0);
  std::vector<std::string> names;
  const Probes probes(scene.at("output"), simulation);
  for (const HistoryColumn& column : probes.columns()) {
    if (column.name.ends_with(" at here")) names.push_back(column.name);
  }
  return names;
}

TEST(Probes, NameTheComponentsOfVectorsAndTensors) {
  const std::string scene = box_2d + quasi_static_2d;
  EXPECT_THAT(columns(scene, "dilatation"), testing::ElementsAre("dilatation at here"));
  EXPECT_THAT(columns(scene, "displacement"),
              testing::ElementsAre("displacement_x at here", "displacement_y at here"));
  EXPECT_THAT(columns(scene, "effective_stress"),
              testing::ElementsAre("effective_stress_xx at here", "effective_stress_xy at here",
                                   "effective_stress_yx at here", "effective_stress_yy at here"));
}

}  // namespace
}  // namespace perifrac
