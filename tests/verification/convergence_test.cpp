#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

using Overrides = std::vector<std::string>;

/// The largest error of the pressure at T = 0.03 to 0.6.
double error_of(const std::string& scene, const Overrides& overrides) {
  const SceneRun run = run_config(scene, overrides);
  EXPECT_EQ(run.exit_code, 0);
  return run.largest("pressure_error", 0.03, 0.61);
}

TEST(Convergence, UnderAHorizonOfTwoSpacingsIsOfSecondOrder) {
  const double coarse = error_of("convergence_delta", {"body.spacing=2 m"});
  const double middle = error_of("convergence_delta", {});
  EXPECT_LE(middle, 5e-4);
  EXPECT_GT(coarse, 3.5 * middle);
}

TEST(Convergence, UnderOneHorizonFallsFromOneSpacingToTwo) {
  // Of the operators alone: stabilised storage takes a tenth off the coarse one's error.
  const std::string alone = "pore_flow.undrained_stabilisation=0";
  const double coarse =
      error_of("convergence_m", {"body.spacing=2 m", "body.horizon_ratio=1", alone});
  const double middle = error_of("convergence_m", {alone});
  EXPECT_LE(middle, 5e-4);
  EXPECT_GT(coarse, 3.5 * middle);
}

}  // namespace
}  // namespace perifrac::test
