#include <cmath>
#include <numbers>

#include "tests/unit/fluid/fluid_run.hpp"

/// The fluid's own balance: what is stored, came and became heat.
namespace perifrac::test {
namespace {

constexpr double turn = 2.0 * std::numbers::pi;

/// A square of 1 m and 1000 kg/m, space repeating both ways, without numerical measures.
const std::string square = R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.05 m
  bulk_modulus: 1 MPa
  viscosity: 0 Pa s
  artificial_viscosity: 0
  density_diffusion: 0
  particle_shifting: 0
  container:
    from: [0 m, 0 m]
    to: [1 m, 1 m]
    faces: {left: periodic, right: periodic, bottom: periodic, top: periodic}
  blocks: [{name: water, from: [0 m, 0 m], to: [1 m, 1 m]}]
)";

/// Velocity 0.1 sin(2 pi x) m/s along `axis`: 2.5 J/m.
void set_wave(FluidRun& run, int axis) {
  std::vector<double> velocity;
  for (const double x : run.field("position_x")) velocity.push_back(0.1 * std::sin(turn * x));
  run.set(std::string("velocity_") + "xy"[axis], velocity);
}

/// Set by set_wave(), and not made.
double made(FluidRun& run) { return run.value("free_fluid_energy_made") - 2.5; }

/// It dies out by viscosity, at 2 nu k^2.
void expect_heat_of_a_shear_wave(const std::string& type, double error, double open) {
  FluidRun run(square, {"fluid.type=" + type, "fluid.viscosity=10 Pa s"});
  set_wave(run, 1);
  ASSERT_NEAR(run.value("free_fluid_energy"), 2.5, 1e-12);
  run.run_for(1.0);
  const double exact = 2.5 * (1.0 - std::exp(-2.0 * 0.01 * turn * turn));
  EXPECT_NEAR(run.value("free_fluid_heat"), exact, error * exact);
  EXPECT_NEAR(made(run), 0.0, open * 2.5);
  EXPECT_EQ(run.value("free_fluid_work"), 0.0);
}

TEST(FluidEnergy, OfAShearWaveBecomesHeat) {
  expect_heat_of_a_shear_wave("semi_lagrangian", 0.011, 1e-4);
  expect_heat_of_a_shear_wave("sph", 0.016, 0.009);
}

/// The most that is made of a standing wave over 1.3 swings, over its energy.
double open_in_sound(double courant) {
  FluidRun run(square, {"fluid.courant=" + std::to_string(courant)});
  set_wave(run, 0);
  double open = 0.0, least = 1.0;
  for (int k = 0; k < 40; ++k) {
    run.run_for(1e-3);
    open = std::max(open, std::abs(made(run)) / 2.5);
    double moving = 0.0;
    const auto mass = run.field("mass"), velocity = run.field("velocity_x");
    for (std::size_t i = 0; i < mass.size(); ++i) {
      moving += 0.5 * mass[i] * velocity[i] * velocity[i];
    }
    least = std::min(least, moving / 2.5);
  }
  EXPECT_LT(least, 1e-3);  // all of it was compression's
  return open;
}

TEST(FluidEnergy, OfSoundStaysToSecondOrderInTheStep) {
  const double coarse = open_in_sound(0.4);
  EXPECT_LT(coarse, 0.0145);
  EXPECT_LT(open_in_sound(0.2), 0.35 * coarse);
}

TEST(FluidEnergy, OfHeightIsGainedThroughAPeriod) {
  FluidRun run("gravity: [1 m/s^2, 0 m/s^2]\n" + square);
  run.run_for(3.0);
  EXPECT_NEAR(run.value("free_fluid_energy"), 4500.0, 1e-9);
  EXPECT_NEAR(run.value("free_fluid_work"), 4500.0, 1e-9);
  EXPECT_NEAR(run.value("free_fluid_energy_made"), 0.0, 1e-9);
}

/// Under a body force, long after it came on: heat is what that force does, rho g times the flux.
TEST(FluidEnergy, BetweenPlatesBecomesHeat) {
  FluidRun run(R"(
dimension: 2
gravity: [0.01 m/s^2, 0 m/s^2]
time: {end: 100 s}
fluid:
  type: semi_lagrangian
  spacing: 0.05 m
  bulk_modulus: 10 kPa
  viscosity: 20 Pa s
  artificial_viscosity: 0
  container: {from: [0 m, 0 m], to: [1 m, 1 m], faces: {left: periodic, right: periodic}}
  blocks: [{name: water, from: [0 m, 0 m], to: [1 m, 1 m]}]
)");
  run.run_for(40.0);
  const double before = run.value("free_fluid_heat");
  run.run_for(10.0);
  const double exact = 1000.0 * 0.01 * (1000.0 * 0.01 / (12.0 * 20.0));
  EXPECT_NEAR((run.value("free_fluid_heat") - before) / 10.0, exact, 0.008 * exact);
  EXPECT_NEAR(run.value("free_fluid_energy_made"), 0.0, 9e-5 * run.value("free_fluid_work"));
}

/// A piston under a load of 100 kN/m on water of half that pressure.
TEST(FluidEnergy, ComesFromAPiston) {
  FluidRun run(R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.05 m
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  container:
    from: [0 m, 0 m]
    to: [1 m, 1 m]
    faces: {left: periodic, right: periodic, top: open}
  blocks: [{name: water, from: [0 m, 0 m], to: [1 m, 1 m], pressure: 50 kPa}]
  walls:
    - {name: press, from: [0 m, 1 m], to: [1 m, 1.2 m], slip: free, motion: piston,
       force: [0 N/m, -100 kN/m], mass: 1000 kg/m}
)");
  run.run_for(0.04);
  const double velocity = run.field("press/velocity_y")[0];
  const double down = -run.field("press/displacement_y")[0];
  ASSERT_GT(down, 0.02);
  const double work = 100e3 * down - 0.5 * 1000.0 * velocity * velocity;
  EXPECT_NEAR(run.value("free_fluid_work"), work, 1e-9 * work);
  EXPECT_NEAR(run.value("free_fluid_energy_made"), 0.0, 0.028 * run.value("free_fluid_energy"));
}

/// Of water between a body and a lid. The work is the body's motion times what it got.
TEST(FluidEnergy, ComesFromABodyThatMoves) {
  FluidRun run(R"(
dimension: 2
time: {end: 10 s}
body: {shape: box, size: [0.5 m, 0.5 m], spacing: 0.1 m}
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  container:
    from: [0 m, 0.5 m]
    to: [0.5 m, 1 m]
    faces: {left: periodic, right: periodic, bottom: open}
  blocks: [{name: water, from: [0 m, 0.5 m], to: [0.5 m, 1 m], pressure: 50 kPa}]
)");
  const PortView moved = run.input("displacement");
  double work = 0.0;
  for (int window = 1; window <= 20; ++window) {
    for (std::size_t k = 0; k < moved.value.size(); ++k) {
      moved.rate[k] = k < moved.value.size() / 2 ? 0.3 : 0.5;
      moved.value[k] = moved.rate[k] * window * 1e-3;
    }
    run.run_for(1e-3);
    const auto impulse = run.values("interface_impulse");
    for (std::size_t k = 0; k < impulse.size(); ++k) work -= moved.rate[k] * impulse[k];
  }
  EXPECT_GT(work, 250.0);  // p V is
  EXPECT_NEAR(run.value("free_fluid_work"), work, 1e-12 * work);
}

/// A closed box takes in a hundredth of its mass: p^2/2K is stored.
TEST(FluidEnergy, ComesWithMass) {
  FluidRun run(square +
               "  inlets: [{name: in, from: [0 m, 0 m], to: [1 m, 1 m], rate: 10 kg/(m s)}]\n");
  run.run_for(1.0);
  ASSERT_NEAR(run.value("free_fluid_mass"), 1010.0, 1e-9);
  EXPECT_NEAR(run.value("free_fluid_energy"), 50.0, 0.01 * 50.0);
  EXPECT_NEAR(run.value("free_fluid_work"), run.value("free_fluid_energy"), 1e-6);
}

/// A block flies into an outlet, or out of the domain: half of it is there yet.
void expect_gone(const std::string& sink) {
  FluidRun run(R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  blocks: [{name: block, from: [0 m, 0 m], to: [1 m, 1 m], velocity: [2 m/s, 0 m/s]}]
)" + sink);
  run.run_for(0.5);
  const double left = run.value("free_fluid_mass");
  ASSERT_GT(left, 300.0);
  ASSERT_LT(left, 700.0);
  EXPECT_NEAR(run.value("free_fluid_energy"), 2.0 * left, 1e-9);
  EXPECT_NEAR(run.value("free_fluid_work"), 2.0 * (left - 1000.0), 1e-9);
}

TEST(FluidEnergy, LeavesWithPoints) {
  expect_gone("  outlets: [{name: out, from: [1.5 m, -1 m], to: [3 m, 2 m]}]\n");
  expect_gone("  domain: {from: [-1 m, -1 m], to: [1.5 m, 2 m], most_lost: 100}\n");
}

}  // namespace
}  // namespace perifrac::test
