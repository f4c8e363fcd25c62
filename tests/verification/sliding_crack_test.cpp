#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/verification/scene_run.hpp"

namespace perifrac::test {
namespace {

/// The closed form of a crack in an infinite plate: it slips in proportion to what the shear has
/// been beyond what faces bear, by as much as it does without friction, and takes what they bear
/// times all the way that they slide. Within 3 % on this lattice: what the faces bear strains the
/// rock that jumps are taken over by more than the rock elsewhere. Where slip begins its ends come
/// first. What friction takes closes the balance of energy.
TEST(SlidingCrack, SlipsToAndFroAndTakesWhatThatDissipates) {
  const std::string coarse = "body.spacing=2.5 mm";
  const SceneRun smooth = run_config("sliding_crack", {coarse, "solid.crack_friction=0",
                                                       "coupling.window={first: 1 s, largest: 1 s}",
                                                       "output.interval=1 s", "time.end=1 s"});
  ASSERT_EQ(smooth.exit_code, 0);
  const double per_stress = smooth.column("crack_slip_area [m^2]").back() / 6e6, borne = 3e6;
  const SceneRun run = run_config("sliding_crack", {coarse, "output.interval=3 s", "time.end=3 s"});
  ASSERT_EQ(run.exit_code, 0);
  const std::vector<double> time = run.column("time [s]"),
                            slip = run.column("crack_slip_area [m^2]"),
                            dissipation = run.column("friction_dissipation [J/m]"),
                            stored = run.column("energy_stored [J/m]"),
                            error = run.column("energy_error [1]");
  const double most = per_stress * borne;  // 6 MPa less 3 MPa
  double drive = 0.0, lost = 0.0, worst = 0.0;
  for (std::size_t k = 1; k < time.size(); ++k) {
    const double shear = 6e6 * (time[k] <= 1.0 ? time[k] : 2.0 - time[k]), before = drive;
    drive = std::clamp(drive, shear - borne, shear + borne);
    lost += borne * per_stress * std::abs(drive - before);
    worst = std::max(worst, std::abs(slip[k] - per_stress * std::abs(drive)));
  }
  EXPECT_LE(worst, 0.09 * most);
  EXPECT_NEAR(slip.back(), most, 0.04 * most);
  EXPECT_NEAR(dissipation.back(), lost, 0.04 * lost);
  const double largest = *std::ranges::max_element(stored);
  EXPECT_LE(std::abs(error.back()) * largest, 7.8e-4 * dissipation.back());
}

}  // namespace
}  // namespace perifrac::test
