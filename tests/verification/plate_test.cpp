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

}  // namespace
}  // namespace perifrac::test
