#include "modules/fluid/as_published/smoothed_exchange.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "modules/fluid/exchange/bond_flux_exchange.hpp"
#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

using test::FluidOverBody;

constexpr double width = 3.0, mass_per_pressure = 4e-5;  // [m], [kg/Pa] of a pore point

/// Fluid over pores that nothing flows into but by smoothing with this coefficient.
struct Smoothed {
  explicit Smoothed(double coefficient)
      : scene(6, 4, 0.5, 0.2), exchange(make_exchange(scene, coefficient)) {
    scene.mobility.assign(scene.mobility.size(), 0.0);
    scene.slope.assign(scene.slope.size(), 1.0 / mass_per_pressure);
    scene.prepare([](const Vector<2>& x) { return 2e4 + 3e3 * x[0]; });
  }

  static SmoothedExchange<2> make_exchange(const FluidOverBody<2>& scene, double coefficient) {
    const auto period = FluidOverBody<2>::make_period(width);
    const double horizon = scene.scheme.horizon;
    auto tight = std::make_unique<BondFluxExchange<2>>(*scene.body, scene.cloud, scene.rigid,
                                                       period, horizon, scene.influence);
    return {std::move(tight), coefficient, *scene.body,    scene.cloud,
            period,           horizon,     scene.influence};
  }

  FluidOverBody<2> scene;
  SmoothedExchange<2> exchange;
};

/// The mean of Eq 32 over all points, fluid and body, less what pore flow has of it.
TEST(SmoothedExchange, MovesPoresTowardsTheMeanInEveryStep) {
  constexpr double coefficient = 0.25, length = 2e-3;
  Smoothed smoothed(coefficient);
  auto& scene = smoothed.scene;
  EXPECT_TRUE(smoothed.exchange.keeps_mass());
  const std::vector<double> rate = smoothed.scene.find(smoothed.exchange, 0.0, length);

  const auto weight = [&](const Vector<2>& x, const Vector<2>& y, double volume) {
    double sum = 0.0;  // with images
    for (int k = -1; k <= 1; ++k) {
      sum +=
          volume * scene.influence(std::pow(y[0] + width * k - x[0], 2) + std::pow(y[1] - x[1], 2));
    }
    return sum;
  };
  for (Index k = 0; k < scene.walls.count; ++k) {
    const Index j = scene.cloud.owner[scene.walls.wall[k]];
    const Vector<2> x = scene.body->points().at(j);
    double weights = 0.0, rise = 0.0;
    for (Index other = 0; other < scene.body->points().size(); ++other) {
      weights += weight(x, scene.body->points().at(other), 0.25);
    }
    for (Index i = 0; i < scene.points.count; ++i) {
      const double of_fluid = coefficient * weight(x, scene.points.at(i), scene.points.volume[i]);
      weights += of_fluid;
      rise += of_fluid * scene.points.pressure[i];
    }
    const double exact = mass_per_pressure * rise / weights;
    EXPECT_NEAR(length * scene.walls.mass_rate[k], exact, 1e-12 * exact) << k;
  }
  const double gained =
      std::accumulate(scene.walls.mass_rate.begin(), scene.walls.mass_rate.end(), 0.0);
  EXPECT_GT(gained, 0.0);
  EXPECT_NEAR(std::accumulate(rate.begin(), rate.end(), 0.0) + gained, 0.0, 1e-13 * gained);
}

TEST(SmoothedExchange, LeavesPressuresAloneThatAreTheSame) {
  Smoothed smoothed(1.0);
  smoothed.scene.prepare([](const Vector<2>&) { return 2e4; });
  smoothed.scene.pressure.assign(smoothed.scene.pressure.size(), 2e4);
  for (const double rate : smoothed.scene.find(smoothed.exchange)) EXPECT_EQ(rate, 0.0);
}

/// Held points take nothing: no mass raises their pressure.
TEST(SmoothedExchange, PassesByPoresWithoutSlope) {
  Smoothed smoothed(1.0);
  smoothed.scene.slope.assign(smoothed.scene.slope.size(), 0.0);
  for (const double rate : smoothed.scene.find(smoothed.exchange)) EXPECT_EQ(rate, 0.0);
}

}  // namespace
}  // namespace perifrac
