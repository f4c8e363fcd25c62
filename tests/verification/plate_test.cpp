#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

TEST(DrainedPlate, IsExact) {
  const SceneRun run = run_config("drained_plate");
  EXPECT_EQ(run.exit_code, 0);
  const auto& last = run.summary["reference"]["table"].back();
  EXPECT_LE(last["displacement_x_error"], 1e-10);
  EXPECT_LE(last["displacement_y_error"], 1e-10);
}

TEST(DrainedPlate, IsExactInThreeDimensions) {
  const SceneRun run = run_config("plate_3d");
  EXPECT_EQ(run.exit_code, 0);
  const auto& last = run.summary["reference"]["table"].back();
  EXPECT_LE(last["displacement_x_error"], 1e-10);
  EXPECT_LE(last["displacement_y_error"], 1e-10);
  EXPECT_LE(last["displacement_z_error"], 1e-10);
}

/// Moments of so many points are projected to 2e-3 only, which errors still fall beside.
TEST(DrainedPlate, ConvergesOnAJitteredCloudInThreeDimensions) {
  double coarser = 0.0;
  for (const char* spacing : {"1 m", "0.5 m"}) {
    const SceneRun run =
        run_config("plate_3d", {"body.jitter=0.2", std::string("body.spacing=") + spacing,
                                "solid.linear_solver.type=multigrid"});
    EXPECT_EQ(run.exit_code, 0);
    double largest = 0.0;
    for (const char axis : {'x', 'y', 'z'}) {
      const double error =
          run.summary["reference"]["table"].back()[std::string("displacement_") + axis + "_error"];
      largest = std::max(largest, error);
    }
    EXPECT_LE(largest, 0.015);
    if (coarser > 0.0) {
      EXPECT_LE(largest, 0.6 * coarser);
    }
    coarser = largest;
  }
}

}  // namespace
}  // namespace perifrac::test
