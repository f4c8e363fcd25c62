#include "modules/fluid/openings/fluid_mouths.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

const FluidProperties water{.density = 1000.0, .bulk_modulus = 1e6, .viscosity = 1e-3};

/// A body of 6 x 4 points and as many points of water above it, a crack opening at (3, 4).
struct Pool {
  std::shared_ptr<const Body<2>> body = test::box_body<2>({6, 4}, 1.0);
  FluidPoints<2> points;
  FluidMouths<2> mouths{{{3.0, 4.0}}, *body, 2.5};
  std::vector<double> impulse = std::vector<double>(2 * 24, 0.0);

  explicit Pool(double pressure = 0.0) {
    const double density = 1000.0 * (1.0 + pressure / 1e6);
    const Points<2> lattice = box_lattice<2>({6, 4}, 1.0, {0, 4});
    for (Index i = 0; i < lattice.size(); ++i) {
      points.add(lattice.at(i), {0.3, -0.1 * i}, density, density);
    }
    points.volume.assign(points.count, 1.0);
  }

  std::vector<double> totals() const {
    double mass = 0.0, x = 0.0, y = 0.0;
    for (Index i = 0; i < points.count; ++i) {
      mass += points.mass[i];
      x += points.mass[i] * points.velocity[0][i];
      y += points.mass[i] * points.velocity[1][i];
    }
    for (std::size_t j = 0; j < 24; ++j) {
      x += impulse[j];
      y += impulse[24 + j];
    }
    return {mass, x, y};
  }

  double asked = 0.0;

  void window(double intake, int steps = 1) {
    asked += intake;
    mouths.taken()[0] = asked;
    mouths.begin_window(steps);
    for (int k = 0; k < steps; ++k) mouths.give(points, 1.0, impulse);
  }
};

/// sum of omega m.
double sum_at_mouth(const Pool& pool) {
  double sum = 0.0;
  for (Index i = 0; i < pool.points.count; ++i) {
    const double r = std::hypot(pool.points.at(i)[0] - 3.0, pool.points.at(i)[1] - 4.0);
    if (r < 2.5) sum += std::exp(-r * r) * pool.points.mass[i];
  }
  return sum;
}

TEST(FluidMouths, GiveWhatCracksTookWithItsMomentum) {
  for (const double intake : {12.0, -12.0}) {
    Pool pool;
    const auto before = pool.totals();
    pool.window(intake, 3);
    const auto after = pool.totals();
    EXPECT_NEAR(before[0] - after[0], intake, 1e-10);
    EXPECT_NEAR(pool.mouths.given(), before[0] - after[0], 1e-10);
    EXPECT_NEAR(after[1], before[1], 1e-10);
    EXPECT_NEAR(after[2], before[2], 1e-10);
    EXPECT_NE(pool.impulse[24 + pool.body->nearest_point({2.5, 3.5})], 0.0);
    EXPECT_EQ(pool.impulse[24 + pool.body->nearest_point({0.5, 0.5})], 0.0);
  }
}

TEST(FluidMouths, TakeFromPointsNearbyAndLowerTheirPressure) {
  Pool pool(1e5);
  pool.window(100.0);
  for (Index i = 0; i < pool.points.count; ++i) {
    const double r = std::hypot(pool.points.at(i)[0] - 3.0, pool.points.at(i)[1] - 4.0);
    if (r < 2.4) {
      EXPECT_LT(pool.points.mass[i], 1100.0);
    } else {
      EXPECT_EQ(pool.points.mass[i], 1100.0);
    }
    EXPECT_NEAR(pool.points.density[i], pool.points.mass[i], 1e-9);  // volumes stay
  }
}

TEST(FluidMouths, GiveNoMoreThanHalfOfWhatThereIsAndOweTheRest) {
  Pool pool;
  const double there = sum_at_mouth(pool);
  const double before = pool.totals()[0];
  pool.window(0.75 * there);
  EXPECT_NEAR(before - pool.totals()[0], 0.5 * there, 1e-9 * there);
  pool.window(0.0);
  EXPECT_NEAR(before - pool.totals()[0], 0.75 * there, 1e-9 * there);
}

TEST(FluidMouths, ForetellHowThePressureFalls) {
  Pool pool(1e5);
  const double stiffness = pool.mouths.stiffness(pool.points, water)[0];
  pool.window(1.0);
  // The mean over the points there, which lost a little each.
  double mean = 0.0;
  for (Index i = 0; i < pool.points.count; ++i) {
    const double r = std::hypot(pool.points.at(i)[0] - 3.0, pool.points.at(i)[1] - 4.0);
    if (r < 2.5)
      mean += std::exp(-r * r) * pool.points.mass[i] * water.pressure(pool.points.density[i]);
  }
  mean /= sum_at_mouth(pool);
  EXPECT_NEAR(1e5 - mean, stiffness * 1.0, 2e-3 * stiffness);
  EXPECT_NEAR(pool.mouths.pressure(pool.points, water)[0], mean, 1e-6);
}

/// 24 points of a square metre, all compressed alike.
TEST(FluidMouths, ForetellHowThePressureFallsForGood) {
  Pool pool(1e5);
  EXPECT_NEAR(pool.mouths.volume_stiffness(pool.points, water)[0], 1e6 / 1000.0 / 24.0, 1e-9);
  EXPECT_NEAR(pool.mouths.relaxation(water)[0], 2.5 / std::sqrt(1e6 / 1000.0), 1e-12);
}

TEST(FluidMouths, AreAtThePressureOfThePointsThere) {
  Pool pool(1e5);
  EXPECT_NEAR(pool.mouths.pressure(pool.points, water)[0], 1e5, 1e-4);
  Pool far(1e5);
  for (double& y : far.points.position[1]) y += 3.0;
  EXPECT_EQ(far.mouths.pressure(far.points, water)[0], 0.0);
  EXPECT_EQ(far.mouths.stiffness(far.points, water)[0], 0.0);
  far.window(5.0);
  EXPECT_EQ(far.mouths.given(), 0.0);
}

}  // namespace
}  // namespace perifrac
