#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

const char* const middle = "pore pressure at the middle";
const char* const peak = "peak in the middle";

/// Undrained pressure of the shipped scene [Pa]: P / (1 + S K).
const double initial = 1e6 / (1.0 + 0.2 / 2.2e9 * 1e9);

TEST(Cryer, MiddleFollowsTheExactHistoryWithItsOvershoot) {
  const SceneRun run = run_config("cryer");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.history(middle), 1e-2 * initial);
  EXPECT_LE(run.history("pore pressure at 0.5 a"), 1e-2 * initial);
  EXPECT_LE(run.figure(peak), 5e-3);
  EXPECT_LE(run.largest("pressure_error", 0.2, 2.0), 2e-2);
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 1e-2);

  const SceneRun coarse = run_config("cryer", {"body.spacing=2 m"});
  EXPECT_GT(coarse.history(middle), 3.0 * run.history(middle));
}

}  // namespace
}  // namespace perifrac::test
