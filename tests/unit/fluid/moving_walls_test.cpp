#include <gtest/gtest.h>

#include "tests/unit/fluid/fluid_run.hpp"

namespace perifrac::test {
namespace {

/// Fluid 8 deep and 4 long under a lid that covers all of one period.
const std::string under_a_lid = R"(
dimension: 2
time: {end: 100 s}
fluid:
  type: semi_lagrangian
  spacing: 1 m
  bulk_modulus: 10 MPa
  viscosity: 10 kPa*s
  artificial_viscosity: 0
  blocks:
    - {name: water, from: [0 m, 0 m], to: [4 m, 8 m]}
  walls:
    - {name: lid, from: [0 m, 8 m], to: [4 m, 11 m], motion: moving, velocity: [0.5 m/s, 0 m/s]}
  container:
    from: [0 m, 0 m]
    to: [4 m, 11 m]
    faces: {left: periodic, right: periodic}
)";

TEST(MovingWalls, DragFluidAlongThroughAnyNumberOfPeriods) {
  FluidRun run(under_a_lid);
  run.run_for(30.0);  // five times depth^2 / nu, and the lid 3.75 periods away
  const auto y = run.field("position_y"), velocity = run.field("velocity_x");
  for (std::size_t i = 0; i < y.size(); ++i)
    EXPECT_NEAR(velocity[i], 0.5 * y[i] / 8.0, 0.05);  // 8 points across
}

TEST(MovingWalls, AreWhereTheyWereAfterAWholePeriod) {
  FluidRun run(under_a_lid);
  run.steps(1);
  const double pull = run.momentum(0);
  ASSERT_GT(pull, 0.0);
  for (const double periods : {1.0, 2.0, -3.0}) {
    FluidRun moved(under_a_lid);
    moved.set("lid/displacement_x", {4.0 * periods});
    moved.steps(1);
    EXPECT_NEAR(moved.momentum(0), pull, 1e-9 * pull) << periods;
  }
}

}  // namespace
}  // namespace perifrac::test
