#include "modules/fluid/walls/wall_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

using test::FluidOverBody;

/// A fluid point thrown at a surface that a crack below it has parted by `opening` [m]: its speed
/// into the surface after a step, and the momentum that the surface took.
std::array<double, 2> thrown_at_crack(double opening) {
  constexpr double crack = 1.5, thrown = 900.0, length = 1e-4;
  FluidOverBody<2> scene(6, 4, 0.5);
  scene.points.position[0][0] = crack;
  scene.points.position[1][0] = 0.25;
  scene.prepare([](const Vector<2>&) { return 0.0; });
  const auto& x = scene.points.position[0];  // no longer in their order
  const auto i = std::ranges::find(x, crack) - x.begin();
  scene.points.velocity[1][i] = -thrown;
  for (double& wall : scene.walls.position[0]) wall += (wall < crack ? -0.5 : 0.5) * opening;
  for (auto& values : scene.walls.force) values.assign(scene.walls.count, 0.0);
  const double before = scene.points.velocity[1][i];
  const double heat = stop_at_walls<2>(scene.step(), length, scene.points, scene.walls);
  const double after = scene.points.velocity[1][i];
  const double lost = 0.5 * scene.points.mass[i] * (before * before - after * after);
  EXPECT_NEAR(heat, lost, 1e-9 * lost);
  const auto& force = scene.walls.force[1];
  return {-scene.points.velocity[1][i],
          -length * std::accumulate(force.begin(), force.end(), 0.0) / scene.points.mass[i]};
}

TEST(WallContact, StopsAPointOverACrackHoweverWide) {
  const double allowed = 0.25 * std::sqrt(2e7 / 1000.0);
  for (const double opening : {0.0, 0.02, 0.1, 0.3}) {
    const auto [speed, momentum] = thrown_at_crack(opening);
    EXPECT_NEAR(speed, allowed, 1e-9 * allowed) << opening;
    EXPECT_NEAR(momentum, 900.0 - speed, 1e-9 * momentum) << opening;
  }
}

}  // namespace
}  // namespace perifrac
