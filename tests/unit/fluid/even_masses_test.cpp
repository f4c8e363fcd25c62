#include "modules/fluid/even_masses.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac::test {
namespace {

constexpr double length = 1e-3;  // of a step [s]

template <int D>
std::array<double, 1 + D> totals(const FluidPoints<D>& points) {
  std::array<double, 1 + D> sum{};
  for (Index i = 0; i < points.count; ++i) {
    sum[0] += points.mass[i];
    for (int a = 0; a < D; ++a) sum[1 + a] += points.mass[i] * points.velocity[a][i];
  }
  return sum;
}

template <int D>
void expect_conservation(int across) {
  FluidOverBody<D> tank(across, 6, 0.1, 0.2);
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> part(0.85, 1.1), speed(-1.0, 1.0);
  for (Index i = 0; i < tank.points.count; ++i) {
    tank.points.mass[i] *= part(bits);
    for (int a = 0; a < D; ++a) tank.points.velocity[a][i] = speed(bits);
  }
  tank.prepare([](const Vector<D>&) { return 0.0; });
  const auto before = totals(tank.points);
  const FluidPoints<D> start = tank.points;
  EvenMasses<D>().step(tank.step(), length, tank.points);
  const auto after = totals(tank.points);
  for (int k = 0; k < 1 + D; ++k) EXPECT_NEAR(after[k], before[k], 1e-13 * before[0]) << k;
  double variance = 0.0, variance_before = 0.0;
  const double whole = 1000.0 * std::pow(0.1, D);
  for (Index i = 0; i < tank.points.count; ++i) {
    const double mass = start.mass[i];
    if (mass < 0.9 * whole) {
      EXPECT_EQ(tank.points.mass[i], mass) << "it is on its way out";
      continue;
    }
    variance += std::pow(tank.points.mass[i] / whole - 1.0, 2);
    variance_before += std::pow(mass / whole - 1.0, 2);
    EXPECT_NEAR(tank.points.mass[i] / tank.points.density[i], mass / start.density[i],
                1e-6 * std::pow(0.1, D))
        << "the volume stays";
  }
  EXPECT_LT(variance, variance_before);
}

TEST(EvenMasses, KeepMassAndMomentum) {
  expect_conservation<2>(12);
  expect_conservation<3>(7);
}

TEST(EvenMasses, DiffuseAtTheirRate) {
  constexpr int across = 24;
  constexpr double spacing = 0.1, k = 2.0 * M_PI / (across * spacing);
  FluidOverBody<2> tank(across, 12, spacing);
  const auto wave = [&](Index i) { return 0.01 * std::cos(k * tank.points.position[0][i]); };
  for (Index i = 0; i < tank.points.count; ++i) tank.points.mass[i] *= 1.0 + wave(i);
  tank.prepare([](const Vector<2>&) { return 0.0; });
  const std::vector<double> before = tank.points.mass;
  EvenMasses<2>().step(tank.step(), length, tank.points);
  const double rate = 0.002 * tank.fluid.sound_speed() * spacing * k * k;
  const double whole = 1000.0 * spacing * spacing;
  for (Index i = 0; i < tank.points.count; ++i) {
    const double y = tank.points.position[1][i];
    if (y < 3.0 * spacing || y > 9.0 * spacing) continue;
    const double lost = (before[i] - tank.points.mass[i]) / (whole * length);
    EXPECT_NEAR(lost, rate * wave(i), 0.03 * 0.01 * rate) << y;
  }
}

}  // namespace
}  // namespace perifrac::test
