#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

using Overrides = std::vector<std::string>;

/// Runs a scene of fluid beside a body, which must end well and keep its mass.
SceneRun run_both(const std::string& name, const Overrides& overrides = {}) {
  const SceneRun run = run_config(name, overrides);
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  return run;
}

TEST(Infiltration, SpreadsAsTheErrorFunctionSays) {
  const SceneRun run = run_both("infiltration");
  EXPECT_LE(run.largest("volume_error", 0.0, 1.0), 2e-2);
  EXPECT_LE(run.largest("pressure_error", 0.0, 1.0), 2e-2);
  EXPECT_LE(run.figure("late flux"), 1e-2);
  EXPECT_LE(run.figure("water pressure"), 5e-3);
}

TEST(ConstantHead, FlowsSteadilyFromAWarmStart) {
  const SceneRun run = run_both("constant_head_warm");
  EXPECT_LE(run.figure("late flux"), 1e-2);
  EXPECT_LE(run.figure("volume passed"), 1e-2);
  EXPECT_LE(run.figure("water pressure"), 5e-3);
  EXPECT_LE(run.largest("pressure_error", 0.0, 1.0), 2e-3);
}

/// Ten times dx^2 S / (3 kappa), beyond which several times too much would pass if fluid did not
/// know how the pores fill up within a window.
TEST(ConstantHead, BearsWindowsLongerThanThePoresTakeToFill) {
  const SceneRun run =
      run_both("constant_head", {"time.end=60 s", "output.times=[50 s]",
                                 "coupling.window.first=3 s", "coupling.window.largest=3 s"});
  EXPECT_LE(run.figure("volume passed"), 2e-2);
  EXPECT_LE(run.figure("water pressure"), 5e-3);
}

/// A long specimen hides where the interface is.
TEST(ConstantHead, MeetsTheWaterAtTheFaceOfAShortSpecimen) {
  const SceneRun run =
      run_both("constant_head_warm",
               {"body.size=[20 m, 10 m]", "pore_flow.initial_gradient=[0 Pa/m, 9810 Pa/m]",
                "fluid.container.from=[0 m, 10 m]", "fluid.container.to=[20 m, 24 m]",
                "fluid.blocks[0].from=[0 m, 10 m]", "fluid.blocks[0].to=[20 m, 20 m]",
                "fluid.walls[0].from=[0 m, 20 m]", "fluid.walls[0].to=[20 m, 23 m]"});
  EXPECT_LE(run.figure("interface offset"), 0.2);
  EXPECT_LE(run.figure("late flux"), 2e-2);
}

TEST(WaterOnPlate, SinksAsABeamDoes) {
  const char* const deflection = "late deflection";
  const SceneRun run = run_both("water_on_plate");
  EXPECT_LE(run.figure(deflection), 3e-2);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 1e-3);
  const SceneRun coarse = run_both("water_on_plate", {"body.spacing=2 cm"});
  EXPECT_GT(coarse.figure(deflection), 2.5 * run.figure(deflection));
}

/// The water weighs more than the plate: a plate without inertia must ask it what it will do.
TEST(WaterOnPlate, IsStableWithoutInertiaWhereIterated) {
  const Overrides plate = {"body.spacing=2 cm", "solid.type=quasi_static", "time.end=0.1 s"};
  EXPECT_EQ(run_config("water_on_plate", plate).exit_code, 1);
  Overrides iterated = plate;
  iterated.push_back("coupling.iterations.max=20");
  const SceneRun run = run_both("water_on_plate", iterated);
  EXPECT_LE(run.figure("late deflection"), 0.5) << "it swings";
}

/// Every one of its 300 points ends by being merged into others, or soaked up.
TEST(DrainingBlob, LeavesNothingBehindAndLosesNothing) {
  const SceneRun run = run_both("draining_blob");
  EXPECT_EQ(run.summary["counts"]["fluid_points"], 0);
}

}  // namespace
}  // namespace perifrac::test
