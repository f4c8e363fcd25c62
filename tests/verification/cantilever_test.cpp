#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

const char* const period = "period of the tip";
const char* const mean = "mean deflection of the tip";

TEST(Cantilever, SwingsAsTimoshenkosBeam) {
  const SceneRun run = run_config("cantilever_dynamic");
  EXPECT_EQ(run.exit_code, 0);
  EXPECT_LE(run.figure(period), 2e-2);
  EXPECT_LE(run.figure(mean), 3e-2);
  EXPECT_LE(run.summary["ledger"]["energy_error"], 2.1e-7);

  const SceneRun coarse = run_config("cantilever_dynamic", {"body.spacing=0.2 m"});
  EXPECT_GT(coarse.figure(period), 3.0 * run.figure(period));
  EXPECT_GT(coarse.figure(mean), 3.0 * run.figure(mean));
}

}  // namespace
}  // namespace perifrac::test
