#include <cmath>

#include <gtest/gtest.h>

#include "app/run/scene_keys.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

using Overrides = std::vector<std::string>;

/// Runs a scene of free fluid, which must end well and keep its mass.
SceneRun run_fluid(const std::string& name, const Overrides& overrides = {}) {
  const SceneRun run = run_config(name, overrides);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  return run;
}

TEST(FluidAtRest, BearsItsWeightAndStaysAtRest) {
  const SceneRun run = run_fluid("hydrostatic");
  EXPECT_LE(run.largest("pressure_error", 0.0, 20.0), 5e-3);
  EXPECT_LE(run.largest("velocity_error", 0.0, 20.0), 5e-3);
  EXPECT_LE(run.history("height at the surface"), 0.025) << "half a spacing";
  const SceneRun coarse = run_fluid("hydrostatic", {"fluid.spacing=0.1 m"});
  EXPECT_GT(coarse.largest("pressure_error", 0.0, 20.0),
            2.0 * run.largest("pressure_error", 0.0, 20.0));
}

TEST(FluidAtRest, BearsItsWeightIn3D) {
  const SceneRun run = run_fluid("tank_3d");
  EXPECT_LE(run.largest("pressure_error", 2.0, 20.0), 1e-2) << "10 points deep";
  EXPECT_LE(run.largest("velocity_error", 0.0, 20.0), 2e-3);
}

TEST(Poiseuille, StartsAndSettlesWithSecondOrder) {
  const Overrides half = {"time.end=1 s", "output.times=[0.1 s, 0.2 s, 0.5 s]"};
  const SceneRun run = run_fluid("poiseuille", half);
  EXPECT_LE(run.largest("velocity_error", 0.0, 1.0), 5e-3);
  EXPECT_LE(run.largest("cross_velocity_error", 0.0, 1.0), 2e-3);
  Overrides coarser = half;
  coarser.push_back("fluid.spacing=1 mm");
  const SceneRun coarse = run_fluid("poiseuille", coarser);
  EXPECT_GT(coarse.largest("velocity_error", 0.0, 1.0),
            3.0 * run.largest("velocity_error", 0.0, 1.0));
}

/// With the 20 points across of the scene: finer ones run farther ahead, see docs/scenes.md.
TEST(DamBreak, FrontRunsAsMeasured) {
  const SceneRun run = run_fluid("dam_break");
  EXPECT_LE(run.largest("front_error", 0.0, 3.33), 0.1);
  const auto& front = run.summary["reference"]["histories"][0];
  const double width = 57.15e-3;
  const double ritter = 2.0 * std::sqrt(9.81 * 2.0 * width);
  for (std::size_t n = 0; n < front["time"].size(); ++n) {
    const double t = front["time"][n], x = front["computed"][n];
    EXPECT_LE(x, width + ritter * t + 1e-3) << t;
  }
}

TEST(DamBreak, ComesToRestInItsTank) {
  Simulation simulation = make_simulation(read_scene(
      PERIFRAC_SOURCE_DIR "/configs/dam_break.yaml",
      {"fluid.spacing=5.715 mm", "time.end=4 s", "output.interval=4 s"}, scene_catalogue()));
  CouplingManager& manager = *simulation.manager;
  manager.initialize(0.0);
  manager.settle();
  const Field velocity = field_named(manager, "fluid_velocity");
  std::vector<double> speed;  // root mean square at the end of each second [m/s]
  for (const double stop : {1.0, 2.0, 3.0, 4.0}) {
    while (manager.time() < stop) manager.advance(stop);
    double sum = 0.0;
    for (const double v : velocity.values()) sum += v * v;
    speed.push_back(std::sqrt(sum / velocity.points().count));
  }
  EXPECT_LT(speed[3], 0.5 * speed[0]);
  EXPECT_LT(speed[3], 0.05 * std::sqrt(9.81 * 0.1143));
  EXPECT_EQ(velocity.points().count, 200);
  for (std::size_t i = 0; i < velocity.points().count; ++i) {
    const double x = velocity.points().position[0][i], y = velocity.points().position[1][i];
    EXPECT_TRUE(x > 0.0 && x < 0.3429 && y > 0.0 && y < 0.05) << x << ' ' << y;
  }
}

/// The other method, by one word: three spacings against the series, before its points lie in
/// disorder; from then on the error falls more slowly (docs/theory.md).
TEST(Sph, StartsFlowBetweenPlatesWithSecondOrder) {
  std::vector<double> error;
  for (const char* spacing : {"1 mm", "0.5 mm", "0.25 mm"}) {
    const SceneRun run =
        run_fluid("poiseuille", {"fluid.type=sph", std::string("fluid.spacing=") + spacing,
                                 "time.end=0.2 s", "output.times=[0.1 s]"});
    error.push_back(run.largest("velocity_error", 0.0, 1.0));
    EXPECT_LE(run.largest("cross_velocity_error", 0.0, 1.0), 5e-4);
  }
  EXPECT_GT(error[0], 3.4 * error[1]);
  EXPECT_GT(error[1], 3.4 * error[2]);
  EXPECT_LE(error[2], 1.4e-3);
}

TEST(Sph, BearsItsWeightAndStaysAtRest) {
  const SceneRun run = run_fluid("hydrostatic", {"fluid.type=sph"});
  EXPECT_LE(run.largest("pressure_error", 0.0, 20.0), 1.2e-2);
  EXPECT_LE(run.largest("velocity_error", 0.0, 20.0), 1e-3);
  EXPECT_LE(run.history("height at the surface"), 0.025) << "half a spacing";
  const SceneRun coarse = run_fluid("hydrostatic", {"fluid.type=sph", "fluid.spacing=0.1 m"});
  EXPECT_GT(coarse.largest("pressure_error", 0.0, 20.0),
            1.5 * run.largest("pressure_error", 0.0, 20.0));
}

TEST(Sph, FrontRunsAsMeasured) {
  const SceneRun run = run_fluid("dam_break", {"fluid.type=sph"});
  EXPECT_LE(run.largest("front_error", 0.0, 3.33), 0.13);
}

}  // namespace
}  // namespace perifrac::test
