#include <cmath>
#include <random>

#include "tests/unit/fluid/fluid_run.hpp"

/// Newton's third law: fluid by itself keeps its momentum, and what walls take it has lost.
namespace perifrac::test {
namespace {

const std::string blob_2d = R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  blocks: [{name: blob, from: [0 m, 0 m], to: [1.2 m, 0.8 m], pressure: 10 kPa}]
  domain: {from: [-100 m, -100 m], to: [100 m, 100 m]}
)";
const std::string blob_3d = R"(
dimension: 3
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  blocks: [{name: blob, from: [0 m, 0 m, 0 m], to: [0.6 m, 0.5 m, 0.5 m], pressure: 10 kPa}]
  domain: {from: [-100 m, -100 m, -100 m], to: [100 m, 100 m, 100 m]}
)";

/// Random velocities of up to 0.1 of the speed of sound; returns the sum of |momentum|.
double shake(FluidRun& run) {
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> value(-3.0, 3.0);
  double size = 0.0;
  const std::vector<double> mass = run.field("mass");
  for (int a = 0; a < run.dimension(); ++a) {
    std::vector<double> velocity(mass.size());
    for (std::size_t i = 0; i < mass.size(); ++i) {
      velocity[i] = value(bits);
      size += mass[i] * std::abs(velocity[i]);
    }
    run.set(std::string("velocity_") + "xyz"[a], velocity);
  }
  return size;
}

class IsolatedFluid
    : public testing::TestWithParam<std::pair<std::string, std::vector<std::string>>> {};

TEST_P(IsolatedFluid, KeepsItsMomentum) {
  FluidRun run(GetParam().first, GetParam().second);
  const double size = shake(run);
  std::vector<double> before;
  for (int a = 0; a < run.dimension(); ++a) before.push_back(run.momentum(a));
  run.steps(1000);
  for (int a = 0; a < run.dimension(); ++a) {
    EXPECT_NEAR(run.momentum(a), before[a], 1e-13 * size) << a;
  }
  EXPECT_EQ(run.field("mass").size(), run.ids().size());
}

INSTANTIATE_TEST_SUITE_P(
    Fluid, IsolatedFluid,
    testing::Values(std::pair{blob_2d, std::vector<std::string>{}},
                    std::pair{blob_3d, std::vector<std::string>{}},
                    std::pair{blob_2d, std::vector<std::string>{"fluid.equation_of_state=tait"}},
                    std::pair{blob_2d, std::vector<std::string>{"fluid.artificial_viscosity=0",
                                                                "fluid.density_diffusion=0"}},
                    std::pair{blob_2d, std::vector<std::string>{"fluid.particle_shifting=1"}},
                    std::pair{blob_2d, std::vector<std::string>{"fluid.type=sph"}},
                    std::pair{blob_3d, std::vector<std::string>{"fluid.type=sph"}}),
    [](const auto& info) { return "case_" + std::to_string(info.index); });

const std::string jet_at_body_2d = R"(
dimension: 2
time: {end: 10 s}
body: {shape: box, size: [1 m, 1 m], spacing: 0.1 m}
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 1 MPa
  viscosity: 100 Pa s
  blocks: [{name: jet, from: [1 m, 0.3 m], to: [1.5 m, 0.7 m], velocity: [-3 m/s, 1 m/s]}]
)";
const std::string jet_at_body_3d = R"(
dimension: 3
time: {end: 10 s}
body: {shape: box, size: [0.5 m, 1 m, 1 m], spacing: 0.1 m}
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 1 MPa
  viscosity: 100 Pa s
  blocks: [{name: jet, from: [0.5 m, 0.3 m, 0.3 m], to: [0.9 m, 0.7 m, 0.7 m],
            velocity: [-3 m/s, 1 m/s, 0.5 m/s]}]
)";

class FluidAtABody
    : public testing::TestWithParam<std::pair<std::string, std::vector<std::string>>> {};

/// The body's share is known point by point.
TEST_P(FluidAtABody, GivesItTheMomentumThatItLoses) {
  FluidRun run(GetParam().first, GetParam().second);
  const int dimension = run.dimension();
  std::vector<double> before, given(dimension, 0.0);
  for (int a = 0; a < dimension; ++a) before.push_back(run.momentum(a));
  const double size = std::abs(before[0]);
  double largest = 0.0;
  for (int window = 0; window < 300; ++window) {
    run.steps(1);
    const std::vector<double> impulse = run.values("interface_impulse");
    const std::size_t count = impulse.size() / dimension;
    for (std::size_t k = 0; k < impulse.size(); ++k) {
      given[k / count] += impulse[k];
      largest = std::max(largest, std::abs(impulse[k]));
    }
  }
  for (int a = 0; a < dimension; ++a) {
    EXPECT_NEAR(before[a] - run.momentum(a), given[a], 1e-12 * size) << a;
  }
  EXPECT_LT(given[0], -0.5 * size);  // it did hit
  EXPECT_GT(std::abs(given[1]), 1e-3 * size);
  EXPECT_GT(largest, 0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Fluid, FluidAtABody,
    testing::Values(std::pair{jet_at_body_2d, std::vector<std::string>{}},
                    std::pair{jet_at_body_3d, std::vector<std::string>{}},
                    std::pair{
                        jet_at_body_2d,
                        std::vector<std::string>{"fluid.blocks[0].velocity=[-12 m/s, 2 m/s]"}},
                    std::pair{jet_at_body_2d, std::vector<std::string>{"fluid.type=sph"}},
                    std::pair{jet_at_body_3d, std::vector<std::string>{"fluid.type=sph"}}),
    [](const auto& info) { return "case_" + std::to_string(info.index); });

/// A heavy piston of the same fluid: the other kind of wall.
TEST(FluidAtAPiston, GivesItTheMomentumThatItLoses) {
  FluidRun run(R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 Pa s
  blocks: [{name: jet, from: [0 m, 0.3 m], to: [0.5 m, 0.7 m], velocity: [-3 m/s, 0 m/s]}]
  walls: [{name: piston, from: [-0.3 m, 0 m], to: [0 m, 1 m], slip: free, motion: piston,
           force: [-1e-9 N/m, 0 N/m], mass: 500 kg/m}]
)");
  const double before = run.momentum(0);
  run.steps(300);
  const double piston = 500.0 * run.field("piston/velocity_x")[0];
  EXPECT_LT(piston, 0.5 * before);
  EXPECT_NEAR(run.momentum(0) + piston, before, 1e-9);
}

}  // namespace
}  // namespace perifrac::test
