#include <algorithm>

#include "tests/unit/fluid/fluid_run.hpp"

/// Fluid thrown at a wall at `mach` times the speed of sound does not enter it.
namespace perifrac::test {
namespace {

struct Throw {
  std::string name;
  double mach;
  std::vector<std::string> overrides{};
};

void PrintTo(const Throw& t, std::ostream* out) { *out << t.name; }

class FluidThrownAtAWall : public testing::TestWithParam<Throw> {};

/// The wall's points are at x < 0. The closest that any fluid point's centre came to its surface.
double closest(const std::string& text, const Throw& how, int steps) {
  FluidRun run(text, how.overrides);
  const double sound = 31.6227766;
  auto velocity = run.field("velocity_x");
  std::ranges::fill(velocity, -how.mach * sound);
  run.set("velocity_x", velocity);
  double least = 1.0;
  for (int n = 0; n < steps; ++n) {
    run.steps(1);
    const auto x = run.field("position_x");
    least = std::min(least, *std::ranges::min_element(x));
  }
  return least;
}

const std::string fluid_2d = R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 cP
  blocks: [{name: jet, from: [0.3 m, 0.5 m], to: [2 m, 0.9 m]}]
)";
const std::string wall_2d = "  walls: [{name: wall, from: [-0.3 m, -1 m], to: [0 m, 3 m]}]\n";
const std::string body_2d = R"(
body: {shape: points, file: none}
)";

TEST_P(FluidThrownAtAWall, DoesNotEnterARigidOne2D) {
  EXPECT_GT(closest(fluid_2d + wall_2d, GetParam(), 400), 0.0);
}

TEST_P(FluidThrownAtAWall, DoesNotEnterARigidOne3D) {
  EXPECT_GT(closest(R"(
dimension: 3
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 1 cP
  blocks: [{name: jet, from: [0.3 m, 0.5 m, 0.5 m], to: [1.3 m, 0.9 m, 0.9 m]}]
  walls: [{name: wall, from: [-0.3 m, -0.5 m, -0.5 m], to: [0 m, 2 m, 2 m]}]
)",
                    GetParam(), 250),
            0.0);
}

INSTANTIATE_TEST_SUITE_P(
    Fluid, FluidThrownAtAWall,
    testing::Values(Throw{"at_a_tenth_of_sound", 0.1}, Throw{"at_three_tenths_of_sound", 0.3},
                    Throw{"between_the_wall_s_points", 0.3,
                          {"fluid.blocks[0].from=[0.3 m, 0.55 m]", "fluid.blocks[0].to=[2 m, 0.95 m]"}}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace perifrac::test
