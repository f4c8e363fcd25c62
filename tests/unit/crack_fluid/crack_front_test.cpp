#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// Stiff: all that came in is in the length.
constexpr CrackLiquid stiff{
    .density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 1e14, .residual_aperture = 1e-9};

/// A dry slit along the x axis.
CrackRun dry_slit(const CrackLiquid& liquid, std::vector<CrackInlet> inlets, int facets) {
  CrackRun run(liquid, std::move(inlets));
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, facets));
  run.open(w);
  return run;
}

TEST(CrackFront, AtConstantRateIsWhereTheVolumeSaysSo) {
  const double rate = 1e-5;
  CrackRun run = dry_slit(stiff, {rate_inlet({0.0, 0.0}, rate)}, 60);
  for (int k = 1; k <= 10; ++k) {
    run.advance(0.02, 4);  // a facet a window: the front's flow is the mean over one
    const double front = rate * run.time() / w;
    EXPECT_NEAR(run.scalar("wetted_length"), front, 1e-8 * front);
    EXPECT_LT(run.mass_error(), 1e-14);
    // Full up to the front, dry beyond.
    const auto fill = run.values("crack_wetted_fraction");
    for (std::size_t f = 0; f < fill.size(); ++f) {
      EXPECT_NEAR(fill[f], std::clamp(front / dx - static_cast<double>(f), 0.0, 1.0), 1e-8) << f;
    }
    // Behind it, pressure falls with the flow that passes.
    const double gradient = 12.0 * stiff.viscosity * rate / (w * w * w);
    const auto p = run.values("crack_pressure");
    EXPECT_NEAR(p[0], gradient * front, 1.01 * gradient * dx);
    EXPECT_NEAR(p[1] - p[2], gradient * dx, 1e-6 * gradient * dx);
    EXPECT_NEAR(run.scalar("fluid_lag"), 60 * dx - front, 1e-8 * front);
    EXPECT_NEAR(run.scalar("crack_volume"), 60 * dx * w, 1e-14 * 60 * dx * w);
    EXPECT_NEAR(run.scalar("mean_crack_pressure"), 0.5 * gradient * front, 0.75 * gradient * dx);
    EXPECT_EQ(run.scalar("inlet_pump_pressure"), p[0]);
    EXPECT_EQ(run.scalar("inlet_pump_opening"), w);
  }
}

TEST(CrackFront, AtConstantPressureGoesWithTheRootOfTime) {
  const double pressure = 1e4;
  CrackRun run = dry_slit(water, {pressure_inlet("in", {0.0, 0.0}, pressure)}, 60);
  for (int k = 1; k <= 10; ++k) {
    run.advance(0.05, 50);
    const double root = std::sqrt(2.0 * w * w * pressure * run.time() / (12.0 * water.viscosity));
    // The inlet is at the first facet's centre.
    EXPECT_NEAR(run.scalar("wetted_length") - 0.5 * dx, root, 0.01 * dx) << run.time();
  }
  EXPECT_LT(run.mass_error(), 1e-14);
}

TEST(CrackFront, DividesEvenlyBetweenEqualArms) {
  CrackRun run(stiff, {rate_inlet({0.5 * dx, 0.0}, 1e-5)});
  const auto stem = straight_line({0.0, 0.0}, 0.0, dx, 5);
  run.add_line(stem);
  run.add_line(straight_line(stem.back(), 0.7, dx, 10));
  run.add_line(straight_line(stem.back(), -0.7, dx, 10));
  run.open(w);
  run.advance(0.05, 20);
  const auto fill = run.values("crack_wetted_fraction");
  const double up = std::accumulate(fill.begin() + 5, fill.begin() + 15, 0.0);
  const double down = std::accumulate(fill.begin() + 15, fill.end(), 0.0);
  EXPECT_NEAR(up, down, 1e-9);
  EXPECT_NEAR(up, 2.5, 1e-6);
}

/// A crack that the fluid has not reached does not lag.
TEST(CrackFront, LagsInTheCracksThatHoldFluid) {
  CrackRun run(stiff, {rate_inlet({0.5 * dx, 0.0}, 1e-5)});
  const auto stem = straight_line({0.0, 0.0}, 0.0, dx, 10);
  run.add_line(straight_line({0.0, 5.0 * dx}, 0.3, dx, 7));
  run.add_line(stem);
  run.add_line(straight_line(stem[5], 0.7, dx, 4));
  run.open(w);
  EXPECT_EQ(run.scalar("fluid_lag"), 0.0);
  EXPECT_EQ(run.scalar("mean_crack_pressure"), 0.0);
  run.advance(0.01, 10);
  EXPECT_NEAR(run.scalar("wetted_length"), 2.0 * dx, 1e-8 * dx);
  EXPECT_NEAR(run.scalar("fluid_lag"), 12.0 * dx, 1e-8 * dx);
}

/// A vapour pressure below zero draws the front on.
TEST(CrackFront, StopsWhereThereIsNoLessPressure) {
  CrackLiquid liquid = water;
  CrackRun still = dry_slit(liquid, {pressure_inlet("in", {0.0, 0.0}, 0.0)}, 10);
  still.advance(1.0, 10);
  EXPECT_NEAR(still.scalar("wetted_length"), dx, 1e-12);
  liquid.vapour_pressure = -1e5;
  CrackRun drawn = dry_slit(liquid, {pressure_inlet("in", {0.0, 0.0}, 0.0)}, 10);
  drawn.advance(1.0, 10);
  EXPECT_NEAR(drawn.scalar("wetted_length"), 10 * dx, 1e-12);
}

}  // namespace
}  // namespace perifrac
