#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

void expect_books_closed(const SceneRun& run, double energy) {
  EXPECT_LE(run.summary["ledger"]["mass_error"], 1e-12);
  EXPECT_LE(run.summary["ledger"]["energy_error"], energy);
}

/// Seven to eight spacings of radius in the end.
TEST(Radial, GrowsAsAPennyShapedCrack) {
  const SceneRun run = run_config("radial");
  ASSERT_EQ(run.exit_code, 0);
  EXPECT_LE(run.figure("radius over the exact, mean of a step"), 0.02);
  EXPECT_LE(run.figure("opening over the exact, mean of a step"), 0.03);
  EXPECT_LE(run.figure("pressure over the exact, mean of a step"), 0.05);
  expect_books_closed(run, 0.02);
}

/// Viscosity counts: K = 1.8 to 2.3. The balance of energy misses the loss where facets fill.
TEST(Radial, GrowsAgainstViscosityToo) {
  const SceneRun run = run_config("radial", {"crack_fluid.viscosity=4 cP"});
  ASSERT_EQ(run.exit_code, 0);
  EXPECT_LE(run.figure("radius over the exact, mean of a step"), 0.03);
  EXPECT_LE(run.figure("opening over the exact, mean of a step"), 0.04);
  EXPECT_LE(run.figure("pressure over the exact, mean of a step"), 0.05);
  expect_books_closed(run, 0.06);
}

}  // namespace
}  // namespace perifrac::test
