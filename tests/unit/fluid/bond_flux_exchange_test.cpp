#include "modules/fluid/exchange/bond_flux_exchange.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

using test::FluidOverBody;
using test::sum;

template <int D>
BondFluxExchange<D> exchange_of(const FluidOverBody<D>& scene) {
  return {*scene.body,          scene.cloud,
          scene.rigid,          FluidOverBody<D>::make_period(scene.body->faces()[1].coordinate),
          scene.scheme.horizon, scene.influence};
}

double largest(const std::vector<double>& values) {
  double result = 0.0;
  for (const double value : values) result = std::max(result, std::abs(value));
  return result;
}

/// Between all pairs, every neighbour searched among all points and their images across.
template <int D>
class BruteForce {
 public:
  BruteForce(const FluidOverBody<D>& scene, double width) : scene_(scene), width_(width) {}

  double into_body(const Vector<D>& fluid_at, double p, double volume) const {
    const Points<D>& body = scene_.body->points();
    const FluidPoints<D>& points = scene_.points;
    double all = 0.0;
    const double own = shape(fluid_at);
    for (Index j = 0; j < body.size(); ++j) {
      const Vector<D> x = body.at(j);
      for_images(x, [&](const Vector<D>& image) {
        const double depth = -image[D - 1];
        if (depth > 0.5) return;
        double square = 0.0, head = p - scene_.pressure[j];
        for (int a = 0; a < D; ++a) {
          square += (image[a] - fluid_at[a]) * (image[a] - fluid_at[a]);
          head -= points.density[0] * scene_.gravity[a] * (fluid_at[a] - image[a]);
        }
        if (scene_.influence(square) == 0.0) return;
        all += 1000.0 * scene_.mobility[j] * scene_.influence(square) * 4.0 * D / (own + shape(x)) *
               (1.0 + fluid_at[D - 1] / depth) * head * volume * body.volume[j];
      });
    }
    return all;
  }

 private:
  template <class Use>
  void for_images(const Vector<D>& x, Use&& use) const {
    for (int k = 0; k < (D == 2 ? 3 : 9); ++k) {
      Vector<D> image = x;
      image[0] += (k % 3 - 1) * width_;
      if (D == 3) image[1] += (k / 3 - 1) * width_;
      use(image);
    }
  }

  /// tr M at x over both phases.
  double shape(const Vector<D>& x) const {
    double sum = 0.0;
    const auto add = [&](const Vector<D>& other, double volume) {
      for_images(other, [&](const Vector<D>& image) {
        double square = 0.0;
        for (int a = 0; a < D; ++a) square += (image[a] - x[a]) * (image[a] - x[a]);
        sum += scene_.influence(square) * square * volume;
      });
    };
    const Points<D>& body = scene_.body->points();
    for (Index j = 0; j < body.size(); ++j) add(body.at(j), body.volume[j]);
    for (Index i = 0; i < scene_.points.count; ++i) {
      add(scene_.points.at(i), scene_.points.volume[i]);
    }
    return sum;
  }

  const FluidOverBody<D>& scene_;
  double width_;
};

template <int D>
void expect_brute_force() {
  FluidOverBody<D> scene(6, 4, 0.5, 0.2);
  scene.gravity[D - 1] = -9.81;
  std::iota(scene.pressure.begin(), scene.pressure.end(), 100.0);
  for (std::size_t j = 0; j < scene.mobility.size(); ++j) scene.mobility[j] *= 1.0 + 0.1 * (j % 7);
  for (Index i = 0; i < scene.points.count; ++i) {
    for (int a = 0; a < D; ++a) scene.points.velocity[a][i] = std::sin(i + 2.0 * a);
  }
  scene.prepare([](const Vector<D>& x) { return 2e4 + 3e3 * x[0] - 1e3 * x[D - 1]; });
  auto exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const BruteForce<D> brute(scene, 3.0);
  const double scale = largest(rate);
  ASSERT_GT(scale, 0.0);
  for (Index i = 0; i < scene.points.count; ++i) {
    const double exact =
        brute.into_body(scene.points.at(i), scene.points.pressure[i], scene.points.volume[i]);
    EXPECT_NEAR(rate[i], -exact, 1e-12 * scale) << i;
  }
  // What the fluid loses, the body gets.
  const double rounding = 1e-13 * scale * scene.points.count;
  EXPECT_NEAR(sum(rate) + sum(scene.walls.mass_rate), 0.0, rounding);
  for (int a = 0; a < D; ++a) {
    double momentum = sum(scene.walls.momentum_rate[a]);
    EXPECT_GT(std::abs(momentum), 1e3 * rounding);
    for (Index i = 0; i < scene.points.count; ++i)
      momentum += rate[i] * scene.points.velocity[a][i];
    EXPECT_NEAR(momentum, 0.0, rounding);
  }
}

TEST(BondFluxExchange, IsTheSumOverAllPairs) {
  expect_brute_force<2>();
  expect_brute_force<3>();
}

template <int D>
void expect_uniform_across() {
  FluidOverBody<D> scene(6, 4, 0.5);
  scene.prepare([](const Vector<D>&) { return 1e4; });
  auto exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const auto expect_rows = [](const auto& position, const std::vector<double>& values) {
    double largest_value = 0.0;
    for (const double v : values) largest_value = std::max(largest_value, std::abs(v));
    for (std::size_t i = 0; i < values.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        if (std::abs(position[D - 1][i] - position[D - 1][j]) > 1e-9) continue;
        EXPECT_NEAR(values[i], values[j], 1e-13 * largest_value);
      }
    }
  };
  expect_rows(scene.points.position, rate);
  expect_rows(scene.walls.position, scene.walls.mass_rate);
  EXPECT_GT(sum(scene.walls.mass_rate), 0.0);
}

TEST(BondFluxExchange, IsUniformAcrossAPeriodicColumn) {
  expect_uniform_across<2>();
  expect_uniform_across<3>();
}

TEST(BondFluxExchange, PassesTheFluxThatTheRockBears) {
  // Still water over a pressure that falls linearly below the surface. The sum over a lattice is
  // not quite the integral that gives Darcy's flux.
  FluidOverBody<2> scene(6, 6, 0.5);
  const double slope = 1e4;  // [Pa/m]
  for (Index j = 0; j < scene.body->points().size(); ++j) {
    scene.pressure[j] = slope * scene.body->points().position[1][j];
  }
  scene.prepare([](const Vector<2>&) { return 0.0; });
  auto exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  const double darcy = 1000.0 * 1e-9 * slope * 3.0;  // [kg/s] through 3 m
  EXPECT_NEAR(sum(scene.walls.mass_rate), 0.918 * darcy, 0.001 * darcy);
  EXPECT_NEAR(sum(rate), -sum(scene.walls.mass_rate), 1e-14 * darcy);
}

TEST(BondFluxExchange, IsNothingWhereFluidAndPoresAreAtRest) {
  FluidOverBody<2> scene(6, 4, 0.5, 0.2);
  scene.gravity = {0.0, -9.81};
  const auto at_rest = [](const Vector<2>& x) { return 1e5 - 9810.0 * x[1]; };
  for (Index j = 0; j < scene.body->points().size(); ++j) {
    scene.pressure[j] = at_rest(scene.body->points().at(j));
  }
  scene.prepare([](const Vector<2>&) { return 1e5; });
  auto exchange = exchange_of(scene);
  const std::vector<double> uneven = scene.find(exchange);
  scene.prepare(at_rest);
  const std::vector<double> rate = scene.find(exchange);
  EXPECT_GT(largest(uneven), 0.0);
  EXPECT_LE(largest(rate), 1e-10 * largest(uneven));
  EXPECT_LE(largest(scene.walls.mass_rate), 1e-10 * largest(uneven));
}

TEST(BondFluxExchange, FollowsThePorePressureWithinTheWindow) {
  FluidOverBody<2> scene(6, 4, 0.5);
  scene.prepare([](const Vector<2>&) { return 1e4; });
  auto exchange = exchange_of(scene);
  const std::vector<double> at_end = scene.find(exchange);
  scene.rate.assign(scene.rate.size(), 500.0);
  const std::vector<double> before = scene.find(exchange, -10.0);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_DOUBLE_EQ(before[i], 1.5 * at_end[i]);
}

TEST(BondFluxExchange, LeavesRigidWallsDry) {
  FluidOverBody<2> scene(6, 4, 0.5);
  scene.rigid.push_back({.name = "floor"});
  scene.cloud.rigid_count = scene.cloud.size();
  std::ranges::fill(scene.cloud.owner, 0);
  scene.prepare([](const Vector<2>&) { return 1e4; });
  auto exchange = exchange_of(scene);
  const std::vector<double> rate = scene.find(exchange);
  EXPECT_THAT(rate, testing::Each(0.0));
  EXPECT_THAT(scene.walls.mass_rate, testing::Each(0.0));
}

}  // namespace
}  // namespace perifrac
