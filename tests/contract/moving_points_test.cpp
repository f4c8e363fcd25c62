#include <cmath>
#include <filesystem>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "app/run/recorder.hpp"
#include "app/run/summary.hpp"
#include "core/base/errors.hpp"
#include "core/base/ranks.hpp"
#include "core/io/hdf5.hpp"
#include "core/io/output_folder.hpp"
#include "tests/contract/fake_modules.hpp"
#include "tests/contract/scene_text.hpp"

/// What an app makes of a scene without a body, on points that move, come and go.
namespace perifrac {
namespace {

using fake::Line;
using fake::Particles;
using fake::Socket;
using testing::ElementsAre;

const std::string no_body = R"(
dimension: 2
time: {end: 1 s}
)";

Simulation without_body(std::unique_ptr<PhysicsModule> module) {
  std::vector<ModuleSlot> modules;
  modules.push_back({"fluid", std::move(module)});
  Simulation simulation{.body = std::shared_ptr<const Body<2>>(), .manager = {}, .end = 1.0};
  simulation.manager =
      std::make_unique<CouplingManager>(std::move(modules), fake::even_windows(0.1));
  simulation.manager->initialize(0.0);
  return simulation;
}

std::unique_ptr<Socket> pressure_on(const Line& line) {
  return std::make_unique<Socket>(std::vector<Port>{{"fluid_pressure", "Pa", PortDirection::out}},
                                  line.set());
}

TEST(MovingPoints, AreCountedWhereThereIsNoBody) {
  const Line line(7, "fluid");
  const Simulation simulation = without_body(pressure_on(line));
  EXPECT_EQ(counts(simulation),
            (nlohmann::json{{"points", 0}, {"ghosts", 0}, {"bonds", 0}, {"fluid_points", 7}}));
  EXPECT_THROW(simulation.points(), std::logic_error);
}

TEST(MovingPoints, AProbeReadsWhatIsAroundItAtEveryMoment) {
  const Line few(3, "fluid"), more(6, "fluid"), none(0, "fluid");
  auto module = pressure_on(few);
  Socket& fluid = *module;
  const Simulation simulation = without_body(std::move(module));
  const Section scene =
      read_scene_text(no_body, {"output.probes=[{name: tank, at: [4.4 m, 0.3 m]}]"});
  Probes probes(scene.at("output"), simulation, 1.0);
  ASSERT_EQ(probes.columns().size(), 2u);
  EXPECT_EQ(probes.columns()[0].name, "fluid_pressure at tank");
  std::vector<double> row;
  fluid.at[0].value = {1.0, 2.0, 3.0};
  probes.append_values(row);
  fluid.at[0] = {more.set(), {1.0, 2.0, 3.0, 4.0, 5.0, 6.0}, {}, {}};
  probes.append_values(row);
  ASSERT_EQ(row.size(), 4u);
  EXPECT_TRUE(std::isnan(row[0]));  // dry: the nearest fluid is two spacings away
  EXPECT_EQ(row[1], 0.0);
  EXPECT_NEAR(row[2], 5.4, 1e-12);
  EXPECT_EQ(row[3], 3.0);
  fluid.at[0] = {none.set(), {}, {}, {}};
  probes.append_values(row);
  EXPECT_TRUE(std::isnan(row[4]));
}

/// A rock from 0 to 12 m, and fluid that reaches beyond it.
TEST(MovingPoints, AProbeOutsideTheBodyLeavesOutItsFields) {
  const Section scene =
      read_scene_text(box_2d + quasi_static_2d,
                      {"output.probes=[{name: in, at: [3 m, 1 m]}, {name: out, at: [20 m, 1 m]}]"});
  const Line line(30, "fluid");
  Simulation rock = make_simulation(scene);
  const std::vector<Port> displacement{{.name = "displacement", .unit = "m", .components = 2}};
  std::vector<ModuleSlot> modules;
  modules.push_back({"fluid", pressure_on(line)});
  modules.push_back({"solid", std::make_unique<Socket>(displacement, &rock.points())});
  Simulation simulation{
      .body = rock.body,
      .manager = std::make_unique<CouplingManager>(std::move(modules), fake::even_windows(0.1)),
      .end = 1.0};
  simulation.manager->initialize(0.0);
  std::vector<std::string> names;
  const Probes probes(scene.at("output"), simulation, 1.0);
  for (const HistoryColumn& column : probes.columns()) names.push_back(column.name);
  EXPECT_THAT(names,
              ElementsAre("fluid_pressure at in", "fluid points read at in", "displacement_x at in",
                          "displacement_y at in", "body points read at in", "fluid_pressure at out",
                          "fluid points read at out"));
  const Section named =
      read_scene_text(box_2d + quasi_static_2d,
                      {"output.probes=[{name: out, at: [20 m, 1 m], field: displacement}]"});
  EXPECT_THROW(Probes(named.at("output"), simulation, 1.0), InputError);
}

std::int64_t points_in_frame(const std::string& folder, int number) {
  const Hdf5Reader frame(folder + "/frames/fluid_00000" + std::to_string(number) + ".hdf");
  EXPECT_EQ(frame.read<double>("VTKHDF/PointData/fluid_pressure").size(),
            frame.read<double>("VTKHDF/Points").size() / 3);
  return frame.read<std::int64_t>("VTKHDF/NumberOfPoints").at(0);
}

TEST(MovingPoints, FramesFollowTheirNumberAndTakeNone) {
  const Line few(3, "fluid"), none(0, "fluid");
  auto module = pressure_on(none);
  Socket& fluid = *module;
  Simulation simulation = without_body(std::move(module));
  Recorder recorder(read_scene_text(no_body), no_body, simulation);
  const std::string folder = testing::TempDir() + "moving_points";
  ranks::on_first([&] {
    std::filesystem::remove_all(folder);
    OutputFolder{folder};
  });
  recorder.open(folder, {});
  recorder.record_output();
  fluid.at[0] = {few.set(), {1.0, 2.0, 3.0}, {}, {}};
  recorder.record_output();
  fluid.at[0] = {none.set(), {}, {}, {}};
  recorder.record_output();
  if (!ranks::is_first()) return;  // which alone writes
  EXPECT_EQ(points_in_frame(folder, 0), 0);
  EXPECT_EQ(points_in_frame(folder, 1), 3);
  EXPECT_EQ(points_in_frame(folder, 2), 0);
}

TEST(MovingPoints, AValueThatIsNotFiniteIsFoundAtItsOwnPoint) {
  Simulation simulation = without_body(std::make_unique<Particles>());
  Recorder recorder(read_scene_text(no_body), no_body, simulation);
  for (int window = 0; window < 4; ++window) simulation.manager->advance(1.0);
  EXPECT_NO_THROW(recorder.check_finite());
  PhysicsModule& fluid = *simulation.manager->modules()[0].module;
  const PortView warmth = fluid.port(1);
  warmth.value[2] = std::numeric_limits<double>::infinity();
  try {
    recorder.check_finite();
    FAIL() << "infinity has passed";
  } catch (const NumericalError& error) {
    const auto& x = warmth.points->position[0];
    EXPECT_EQ(error.place(), describe_point(2, std::array{x[2], 0.0}));
  }
}

}  // namespace
}  // namespace perifrac
