#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

TEST(ConstantHead, FillsTheSpecimenThenFlowsSteadily) {
  const SceneRun run = run_config("constant_head");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.largest("volume_error", 0.0, 1.0), 2e-2);
  EXPECT_LE(run.largest("pressure_error", 0.0, 1.0), 2e-2);
  EXPECT_LE(run.figure("late flux"), 1e-2);
  EXPECT_LE(run.figure("water pressure"), 5e-3);
}

}  // namespace
}  // namespace perifrac::test
