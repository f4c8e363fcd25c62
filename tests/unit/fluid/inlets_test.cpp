#include <cmath>
#include <numeric>
#include <set>

#include <gmock/gmock.h>

#include "core/base/errors.hpp"
#include "tests/unit/fluid/fluid_run.hpp"

namespace perifrac::test {
namespace {

/// A closed vessel, empty but for what a test adds.
const std::string vessel = R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 0.1 MPa
  viscosity: 1 cP
  container: {from: [0 m, 0 m], to: [2 m, 1 m]}
)";
const std::string water = R"(
  blocks:
    - {name: water, from: [0 m, 0 m], to: [2 m, 1 m]}
)";
const std::string shallow_water = R"(
  blocks:
    - {name: water, from: [0 m, 0 m], to: [2 m, 0.5 m]}
)";
const std::string pump = R"(
  inlets:
    - {name: pump, from: [0.8 m, 0.1 m], to: [1.2 m, 0.3 m], rate: 100 kg/(m s)}
)";

double total(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

TEST(Inlets, GiveMassToPointsInTheBoxInProportionToVolume) {
  FluidRun run(vessel + water + pump,
               {"fluid.inlets[0].from=[0.8 m, 0.4 m]", "fluid.inlets[0].to=[1.2 m, 0.6 m]"});
  const auto x = run.field("position_x"), y = run.field("position_y"), mass = run.field("mass"),
             density = run.field("density");
  const double length = run.module().stable_time_step();
  run.steps(1);
  // Neighbour search sorts points: compare by id.
  const auto ids = run.ids();
  const auto new_mass = run.field("mass"), new_density = run.field("density");
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::size_t i = ids[k];
    const bool inside = x[i] > 0.8 && x[i] < 1.2 && y[i] > 0.4 && y[i] < 0.6;
    const double gained = inside ? 100.0 * length / 8.0 : 0.0;
    EXPECT_NEAR(new_mass[k] - mass[i], gained, 1e-12 * mass[i]);
    EXPECT_NEAR(new_density[k] - density[i], gained / 0.01, 1e-9 * density[i]);
  }
}

TEST(Inlets, GiveMassToPointsAwayFromWallsWhereThereAreSome) {
  FluidRun run(vessel + water + pump, {"fluid.inlets[0].from=[0.8 m, 0 m]"});
  const auto y = run.field("position_y"), mass = run.field("mass");
  run.steps(1);
  const auto ids = run.ids();
  const auto new_mass = run.field("mass");
  for (std::size_t k = 0; k < ids.size(); ++k) {
    const std::size_t i = ids[k];
    // The row at 0.25 is 0.3 from the wall's first one, farther than the horizon.
    if (y[i] > 0.2 && y[i] < 0.3) continue;
    EXPECT_EQ(new_mass[k], mass[i]);
  }
  EXPECT_GT(run.value("injected_fluid_mass"), 0.0);
}

TEST(Inlets, DriveThroughAChannelWhatTheyLetIn) {
  // Into 10 mm by 40 mm at 0.02 kg/(m s); the box ends at three walls.
  FluidRun run(R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 1 mm
  bulk_modulus: 1 kPa
  viscosity: 50 cP
  artificial_viscosity: 0
  blocks: [{name: all, from: [0 mm, 0 mm], to: [40 mm, 10 mm]}]
  inlets: [{name: in, from: [0 mm, 0 mm], to: [6 mm, 10 mm], rate: 0.02 kg/(m s), schedule: {ramp: 0.2 s}}]
  outlets: [{name: out, from: [38 mm, 0 mm], to: [40 mm, 10 mm]}]
  container: {from: [0 mm, 0 mm], to: [40 mm, 10 mm], faces: {right: open}}
)");
  run.run_for(1.5);
  const auto x = run.field("position_x"), mass = run.field("mass"), v = run.field("velocity_x");
  double flow = 0.0;  // in the middle quarter, times its length
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (std::abs(x[i] - 0.02) < 0.005) flow += mass[i] * v[i];
  }
  EXPECT_NEAR(flow / 0.01, 0.02, 0.1 * 0.02);
}

TEST(Inlets, MassIsExact) {
  FluidRun run(vessel + shallow_water + pump);
  const double before = total(run.field("mass"));
  run.run_for(2.0);
  const double after = total(run.field("mass"));
  EXPECT_NEAR(run.value("injected_fluid_mass"), after - before, 1e-13 * after);
  EXPECT_NEAR(run.value("free_fluid_mass"), after, 1e-13 * after);
  // All that came is in the fluid, or waits: less than a point.
  const double waiting = run.field("pump/waiting_mass")[0];
  EXPECT_NEAR(run.value("injected_fluid_mass") + waiting, 200.0, 1e-9);
  EXPECT_LT(waiting, 10.0);
}

TEST(Inlets, SplitPointsHaveIdsOfTheirOwnAndNoneIsHeavy) {
  FluidRun run(vessel + shallow_water + pump);
  run.run_for(1.0);
  const auto ids = run.ids();
  EXPECT_EQ(std::set(ids.begin(), ids.end()).size(), ids.size());
  EXPECT_GE(ids.size(), 105u);
  for (const double mass : run.field("mass")) EXPECT_LE(mass, 15.0);
}

TEST(Inlets, FillADryVessel) {
  FluidRun run(vessel + pump, {"gravity=[0 m/s^2, -9.81 m/s^2]"});
  EXPECT_EQ(run.value("free_fluid_mass"), 0.0);
  run.run_for(0.05);
  EXPECT_EQ(run.ids().size(), 0u);
  EXPECT_NEAR(run.field("pump/waiting_mass")[0], 5.0, 1e-9);
  run.run_for(0.06);
  ASSERT_EQ(run.ids().size(), 1u);  // of the first ten kilograms
  run.run_for(3.0);
  EXPECT_NEAR(run.value("injected_fluid_mass") + run.field("pump/waiting_mass")[0], 311.0, 1e-9);
  EXPECT_NEAR(run.value("free_fluid_mass"), run.value("injected_fluid_mass"), 1e-10);
  for (const double x : run.field("position_x")) EXPECT_TRUE(x > 0.0 && x < 2.0) << x;
  for (const double y : run.field("position_y")) EXPECT_TRUE(y > 0.0 && y < 1.0) << y;
}

TEST(Inlets, FollowTheirSchedule) {
  FluidRun run(vessel + water + pump,
               {"fluid.inlets[0].schedule={times: [0 s, 0.2 s, 0.2001 s], factors: [1, 1, 0]}"});
  run.run_for(0.5);
  EXPECT_NEAR(run.value("injected_fluid_mass"), 20.0, 0.02);
  const double stopped = run.value("injected_fluid_mass");
  run.run_for(0.1);
  EXPECT_EQ(run.value("injected_fluid_mass"), stopped);
}

/// Mass from one place spreads over a full, closed vessel, and is pressed into its volume.
TEST(Inlets, RaiseThePressureOfAFullVessel) {
  FluidRun run(vessel + water + pump,
               {"fluid.viscosity=100 Pa s",
                "fluid.inlets[0].schedule={times: [0 s, 0.5 s, 0.501 s], factors: [1, 1, 0]}"});
  run.run_for(1.0);
  const auto mass = run.field("mass"), density = run.field("density");
  EXPECT_NEAR(total(mass), 2050.0, 0.1);
  double volume = 0.0;
  for (std::size_t i = 0; i < mass.size(); ++i) volume += mass[i] / density[i];
  EXPECT_NEAR(volume, 2.0, 0.02);
  for (const double p : run.values("fluid_pressure")) EXPECT_GT(p, 1500.0);
}

TEST(Inlets, WaitWhileAWallIsInTheWay) {
  FluidRun run(
      vessel + pump +
          "  walls: [{name: gate, from: [0.5 m, 0.4 m], to: [1.5 m, 0.7 m], motion: moving, "
          "velocity: [0 m/s, -2 m/s], schedule: {times: [0 s, 0.1 s, 0.1001 s], factors: "
          "[1, 1, 0]}}]\n",
      {"fluid.inlets[0].schedule={times: [0.1 s, 0.11 s], factors: [0, 1]}"});
  run.run_for(0.5);
  EXPECT_EQ(run.ids().size(), 0u);
  EXPECT_GT(run.field("pump/waiting_mass")[0], 10.0);
}

TEST(Inlets, WaitWhileAWallIsInTheWayWholePeriodsOn) {
  FluidRun run(vessel + pump +
                   "  walls: [{name: gate, from: [0.5 m, 0.4 m], to: [1.5 m, 0.7 m], motion: "
                   "moving, velocity: [0 m/s, 0 m/s]}]\n",
               {"fluid.container.faces={left: periodic, right: periodic}"});
  run.set("gate/displacement_x", {4.0});  // two periods
  run.set("gate/displacement_y", {-0.3});
  run.run_for(0.5);
  EXPECT_EQ(run.ids().size(), 0u);
  EXPECT_GT(run.field("pump/waiting_mass")[0], 10.0);
}

const std::string drain = R"(
  outlets:
    - {name: drain, from: [1.8 m, 0 m], to: [2 m, 0.2 m]}
)";

TEST(Outlets, CountWhatTheyTake) {
  FluidRun run(vessel + shallow_water + drain, {"gravity=[0 m/s^2, -9.81 m/s^2]"});
  const double before = total(run.field("mass"));
  run.run_for(1.0);
  const double after = total(run.field("mass"));
  EXPECT_LT(after, 0.9 * before);
  EXPECT_NEAR(run.value("removed_fluid_mass"), after - before, 1e-12 * before);
  EXPECT_FALSE(run.has("injected_fluid_mass"));
  EXPECT_FALSE(run.has("points_left"));
}

TEST(FluidDomain, ALeakEndsTheRunWithTheFirstPointThatLeft) {
  FluidRun run(vessel + shallow_water,
               {"fluid.domain={from: [-1 m, 0 m], to: [3 m, 2 m]}",
                "fluid.container.faces.bottom=open", "gravity=[0 m/s^2, -9.81 m/s^2]"});
  EXPECT_FALSE(run.has("points_left"));
  try {
    run.run_for(1.0);
    FAIL() << "nothing was said of the leak";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.field(), "fluid_position");
    EXPECT_THAT(error.what(), testing::HasSubstr("leak"));
    EXPECT_THAT(error.place(), testing::StartsWith("point "));
    EXPECT_GT(error.time(), 0.0);
    EXPECT_LT(error.time(), 0.3);
  }
}

TEST(FluidDomain, CountsThePointsThatMayLeave) {
  FluidRun run(vessel + shallow_water,
               {"fluid.domain={from: [-1 m, 0 m], to: [3 m, 2 m], most_lost: 1000}",
                "fluid.container.faces.bottom=open", "gravity=[0 m/s^2, -9.81 m/s^2]"});
  run.run_for(1.0);
  EXPECT_EQ(run.value("points_left"), 100.0 - static_cast<double>(run.ids().size()));
  EXPECT_GT(run.value("points_left"), 50.0);
  EXPECT_NEAR(run.value("removed_fluid_mass"), -10.0 * run.value("points_left"),
              1e-3 * run.value("points_left"));
}

TEST(FluidDomain, IsGenerousWhereTheSceneSaysNothing) {
  FluidRun run(vessel + shallow_water,
               {"fluid.container.faces.top=open", "fluid.blocks[0].velocity=[0 m/s, 6 m/s]",
                "gravity=[0 m/s^2, -9.81 m/s^2]"});
  run.run_for(0.6);
  const auto y = run.field("position_y");
  EXPECT_GT(*std::ranges::max_element(y), 1.5);  // high above the open face
}

}  // namespace
}  // namespace perifrac::test
