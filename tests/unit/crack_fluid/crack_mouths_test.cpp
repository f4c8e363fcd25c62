#include "modules/crack_fluid/crack_mouths.hpp"

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// Five facets of a millimetre, 50 um wide, open into free fluid at their beginning.
CrackRun run_from_fluid(double pressure, double stiffness) {
  CrackInlet mouth = pressure_inlet("mouth", {0.0, 0.0}, 0.0);
  mouth.holds_pressure = false;
  mouth.from_fluid = true;
  CrackRun run(water, {mouth});
  run.add_line(straight_line({0.0, 0.0}, 0.0, 1e-3, 5));
  run.open(5e-5);
  run.port("mouth_pressure").value[0] = pressure;
  run.port("mouth_stiffness").value[0] = stiffness;
  return run;
}

TEST(CrackMouths, FillTheCrackUnderTheFluidsPressure) {
  CrackRun run = run_from_fluid(1e5, 1e-3);
  double taken = 0.0;
  for (int window = 0; window < 50; ++window) {
    run.advance(1e-4);
    taken = run.scalar("mouth_taken");
    EXPECT_NEAR(run.scalar("crack_fluid_stored_mass"), taken, 1e-15);
    EXPECT_NEAR(run.scalar("mass_taken_by_cracks"), -taken, 1e-15);
  }
  EXPECT_EQ(run.scalar("injected_crack_fluid_mass"), 0.0);
  for (const double p : run.values("crack_pressure")) EXPECT_NEAR(p, 1e5, 1.0);
  EXPECT_NEAR(taken, 1000.0 * (1.0 + 1e5 / water.bulk_modulus) * 5e-3 * 5e-5, 1e-12);
}

TEST(CrackMouths, LetFluidOutWhereItsPressureIsLower) {
  CrackRun run = run_from_fluid(1e6, 1e-3);
  run.advance(1e-3, 50);
  run.port("mouth_pressure").value[0] = 1e5;
  const double before = run.scalar("mouth_taken");
  run.advance(1e-3);
  EXPECT_LT(run.scalar("mouth_taken"), before);
}

/// What is taken lowers the pressure that it is taken at, also where a window is cut.
TEST(CrackMouths, FeelWhatTheyTake) {
  for (const double stiffness : {1e6, 1e8, 1e10}) {
    CrackRun run = run_from_fluid(1e5, stiffness);
    for (int window = 0; window < 10; ++window) {
      const double before = run.scalar("mouth_taken");
      run.port("mouth_given").value[0] = before;  // one window late, as the fluid is
      run.advance(1e-4);
      // No less than that of a crack which is still filling. Nothing relaxes, and the fluid has
      // not yet given what the window took.
      const double expected = std::max(0.0, 1e5 - stiffness * (run.scalar("mouth_taken") - before));
      EXPECT_GT(run.scalar("mouth_taken"), before);
      EXPECT_NEAR(run.values("crack_pressure")[0], expected, 1e-3);
    }
  }
}

/// In a window long beside the time that sound takes, what lies at the mouth answers with that part
/// of its stiffness, and all the fluid with its own; what was given meanwhile is in the pressure.
TEST(CrackMouths, FeelSoundAndTheWholeOfTheFluid) {
  constexpr double local = 1e10, whole = 1e8, tau = 2e-5, length = 1e-4;
  CrackRun run = run_from_fluid(1e5, local);
  run.port("mouth_volume_stiffness").value[0] = whole;
  run.port("mouth_relaxation").value[0] = tau;
  const double x = length / tau, phi = (1.0 - std::exp(-x)) / x;
  double given = 0.0, excess = 0.0;
  for (int window = 0; window < 10; ++window) {
    const double before = run.scalar("mouth_taken");
    const double gives = 0.5 * (before - given);
    given += gives;
    run.port("mouth_given").value[0] = given;
    run.advance(length);
    const double taken = run.scalar("mouth_taken");
    excess = std::exp(-x) * excess + phi * (gives - (taken - before));
    const double expected = 1e5 - whole * (taken - given) + (local - whole) * excess;
    if (expected > 0.0) {
      EXPECT_NEAR(run.values("crack_pressure")[0], expected, 1e-3);
    }
  }
}

TEST(CrackMouths, AreShutWhereNoFluidIs) {
  CrackRun run = run_from_fluid(0.0, 0.0);
  run.advance(1e-3);
  EXPECT_EQ(run.scalar("mouth_taken"), 0.0);
  EXPECT_EQ(run.scalar("crack_fluid_stored_mass"), 0.0);
}

}  // namespace
}  // namespace perifrac
