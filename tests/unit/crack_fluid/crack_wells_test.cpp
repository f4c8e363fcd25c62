#include "modules/crack_fluid/crack_wells.hpp"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/state/snapshot.hpp"
#include "modules/crack_fluid/uniform_pressure/uniform_pressure.hpp"
#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

constexpr double rate = 1e-5;

/// Two cracks of ten facets, one of which may be softer, and a well with a cluster in the midst of
/// each.
CrackRun two_cracks(double resistance, double other, bool viscous = true, Schedule schedule = {},
                    double full = rate) {
  CrackLiquid liquid = water;
  liquid.residual_aperture = 1e-7;
  std::unique_ptr<CrackFlow> flow;
  if (viscous) {
    flow = std::make_unique<Lubrication>(liquid);
  } else {
    flow = std::make_unique<UniformPressure>(liquid);
  }
  CrackRun run(liquid, {cluster("a", {5.5 * dx, 0.0}), cluster("b", {5.5 * dx, 1.0})}, {}, nullptr,
               std::move(flow), {{"w", full, std::move(schedule), {resistance, other}}});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.add_line(straight_line({0.0, 1.0}, 0.0, dx, 10));
  return run;
}

/// Facets of the second crack answer `softer` times as much to pressure, and open beyond `closed`.
void open(CrackRun& run, double compliance, double softer = 1.0, double closed = 0.0,
          double other_closed = 0.0) {
  run.open(0.0, compliance);
  const PortView view = run.port("free_crack_opening");
  for (std::size_t f = 0; f < 20; ++f) {
    if (f >= 10) view.slope[f * 20 + f] *= softer;
    view.value[f] = -view.slope[f * 20 + f] * (f < 10 ? closed : other_closed);
  }
}

struct Shares {
  double a, b, at_a, at_b, well;
};
Shares shares(CrackRun& run) {
  return {run.scalar("inlet_a_rate"), run.scalar("inlet_b_rate"), run.scalar("inlet_a_pressure"),
          run.scalar("inlet_b_pressure"), run.scalar("well_w_pressure")};
}

/// Crump & Conway (1988): 12 perforations of 10 mm lose 0.61 MPa at a barrel a second.
TEST(CrackWells, PerforationsLoseByTheOrifice) {
  const double resistance = perforation_resistance(1000.0, 12.0, 0.01, 0.8);
  const double one = 0.159 / 12.0, area = 0.25 * M_PI * 0.01 * 0.01;
  EXPECT_NEAR(resistance * 0.159 * 0.159, 0.5 * 1000.0 * std::pow(one / (0.8 * area), 2.0), 1e-6);
}

/// Rates and pressure of openings under given pressures, from any rates: what they were made of.
TEST(CrackWells, ShareByWhatTheyLose) {
  std::mt19937 random(7);
  const auto between = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  for (int trial = 0; trial < 200; ++trial) {
    const double p_w = between(0.0, 1e8);
    std::vector<WellFlow::Opening> openings;
    std::vector<double> exact;
    Eigen::VectorXd pressure(5);
    double sum = 0.0;
    for (int k = 0; k < 5; ++k) {
      const double q = between(-0.3, 1.0) * rate;  // out of some cracks
      const double resistance = std::pow(10.0, between(3.0, 8.0)) / (rate * rate);
      exact.push_back(q);
      pressure[k] = p_w - resistance * q * std::abs(q);
      openings.push_back({.facet = k, .resistance = resistance, .rate = between(-1.0, 1.0) * rate});
      sum += q;
    }
    WellFlow well(openings, sum, {1e-9 / rate, -1e12, 1.0});
    int steps = 0;
    for (well.begin(); !well.is_settled() && steps < 60; ++steps) well.follow(pressure);
    EXPECT_LE(steps, 20) << trial;
    EXPECT_NEAR(well.pressure(), p_w, 1e-8 * p_w + 1e-2);
    double total = 0.0;
    for (int k = 0; k < 5; ++k) {
      total += well.openings()[k].rate;
      EXPECT_NEAR(well.openings()[k].rate, exact[k], 3e-4 * rate) << trial;
    }
    EXPECT_NEAR(total, sum, 1e-14 * rate);
  }
}

TEST(CrackWells, EqualClustersShareAlike) {
  for (const bool viscous : {true, false}) {
    for (const double resistance : {0.0, 1e5 / (rate * rate)}) {
      CrackRun run = two_cracks(resistance, resistance, viscous);
      for (const double length : {1e-3, 0.05, 0.2, 1.0}) {
        open(run, 1e-10);
        run.advance(length, 5);
        const auto [a, b, at_a, at_b, well] = shares(run);
        EXPECT_NEAR(a, 0.5 * rate, 1e-9 * rate);
        EXPECT_NEAR(b, 0.5 * rate, 1e-9 * rate);
        EXPECT_NEAR(at_a, at_b, 1e-7 * std::abs(at_a));
        EXPECT_LT(run.mass_error(), 1e-15);
      }
    }
  }
}

/// From no friction, where both cracks are at one pressure, to so much that they share alike.
TEST(CrackWells, UnequalCracksShareByFriction) {
  for (const bool viscous : {true, false}) {
    for (const double lost : {0.0, 1e3, 1e5, 1e7, 1e10}) {
      const double resistance = lost / (rate * rate), other = 4.0 * resistance;
      CrackRun run = two_cracks(resistance, other, viscous);
      open(run, 1e-10, 3.0);
      for (int window = 0; window < 40; ++window) {
        run.advance(0.02);
        const auto [a, b, at_a, at_b, well] = shares(run);
        EXPECT_NEAR(a + b, rate, 1e-14 * rate);
        const double tolerance = 3.0 + 1e-6 * lost;
        EXPECT_NEAR(well - at_a, resistance * a * std::abs(a), tolerance);
        EXPECT_NEAR(well - at_b, other * b * std::abs(b), tolerance);
      }
      const auto [a, b, at_a, at_b, well] = shares(run);
      if (lost == 0.0) {
        EXPECT_GT(b, 1.5 * a);
      }
      if (lost == 1e10) {
        EXPECT_NEAR(a, 2.0 * b, 4e-4 * rate);  // sqrt(R_b / R_a)
      }
      EXPECT_NEAR(run.scalar("injected_crack_fluid_mass"), water.density * rate * run.time(),
                  1e-14 * water.density * rate * run.time());
      EXPECT_LT(run.mass_error(), 1e-14);
    }
  }
}

/// A crack under more stress than the other is ever pressed open with.
TEST(CrackWells, AClosedClusterTakesNothing) {
  for (const bool viscous : {true, false}) {
    CrackRun run = two_cracks(0.0, 0.0, viscous);
    open(run, 1e-10, 1.0, 1e6, 1e8);
    run.advance(2.0, 20);
    const auto [a, b, at_a, at_b, well] = shares(run);
    EXPECT_LT(std::abs(b), 1e-3 * rate);
    EXPECT_NEAR(a, rate, 1e-3 * rate);
    EXPECT_LT(at_a, 1e8);
    EXPECT_GT(at_a, 1e6);
  }
}

/// Once nothing is pumped the crack under more pressure feeds the other until both are alike.
TEST(CrackWells, ShutInTheyFeedEachOther) {
  for (const bool viscous : {true, false}) {
    const double resistance = 1e5 / (rate * rate);
    CrackRun run = two_cracks(resistance, 100.0 * resistance, viscous,
                              Schedule::table({1.0, 1.001}, {1.0, 0.0}));
    open(run, 1e-10);
    run.advance(1.0, 20);
    run.advance(0.001);
    const Shares before = shares(run);
    EXPECT_GT(before.at_a, 1.2 * before.at_b);
    run.advance(0.1);
    const Shares then = shares(run);
    EXPECT_LT(then.a, -1e-3 * rate);
    EXPECT_NEAR(then.a + then.b, 0.0, 1e-14 * rate);
    run.advance(50.0, 40);
    const Shares after = shares(run);
    EXPECT_NEAR(after.at_a, after.at_b, 1e-6 * after.at_a);
    EXPECT_NEAR(run.scalar("injected_crack_fluid_mass"), water.density * rate * 1.0005,
                1e-13 * rate * water.density);
  }
}

/// A well that takes out more than there is ends at the vapour pressure with nothing left.
TEST(CrackWells, TakesOutWhatThereIs) {
  for (const bool viscous : {true, false}) {
    CrackRun run = two_cracks(1e3 / (rate * rate), 1e3 / (rate * rate), viscous,
                              Schedule::table({0.0, 0.5, 0.5001}, {1.0, 1.0, -1.0}));
    open(run, 1e-10, 2.0);
    run.advance(0.5, 10);
    run.advance(3.0, 60);
    const auto [a, b, at_a, at_b, well] = shares(run);
    EXPECT_EQ(well, 0.0);
    EXPECT_LT(std::abs(a + b), 0.01 * rate);
    EXPECT_GE(run.scalar("crack_fluid_stored_mass"), 0.0);
    EXPECT_LT(run.scalar("crack_fluid_stored_mass"), 0.05 * water.density * rate * 0.5);
    EXPECT_LT(
        std::abs(run.scalar("crack_fluid_stored_mass") - run.scalar("injected_crack_fluid_mass")),
        1e-14 * water.density * rate);
  }
}

/// One that feeds two facets is no more to a well, where perforations lose nothing, than one that
/// feeds one.
TEST(CrackWells, WhatDryCracksTakeIsSharedByCluster) {
  CrackRun run(water, {cluster("a", {5 * dx, 0.0}), cluster("b", {5.5 * dx, 1.0})}, {}, nullptr,
               nullptr, {{"w", rate, {}, {0.0, 0.0}}});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.add_line(straight_line({0.0, 1.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(1e-4);
  EXPECT_NEAR(run.scalar("inlet_a_rate"), 0.5 * rate, 1e-12 * rate);
}

/// A cluster between two facets feeds both alike, as one with all its perforations would.
TEST(CrackWells, AClusterBetweenFacetsFeedsBoth) {
  const double resistance = 1e5 / (rate * rate);
  CrackRun run(water, {cluster("a", {5 * dx, 0.0})}, {}, nullptr, nullptr,
               {{"w", rate, {}, {resistance}}});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(w);
  run.advance(0.02, 20);
  const auto mass = run.values("crack_fluid_mass");
  for (int f = 0; f < 10; ++f) EXPECT_NEAR(mass[f], mass[9 - f], 1e-12 * mass[5]) << f;
  EXPECT_NEAR(run.scalar("inlet_a_rate"), rate, 1e-15 * rate);
  EXPECT_NEAR(run.scalar("well_w_pressure") - run.scalar("inlet_a_pressure"), 1e5, 5.0);
}

}  // namespace
}  // namespace perifrac
