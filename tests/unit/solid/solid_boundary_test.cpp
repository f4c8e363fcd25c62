#include "modules/solid/boundary/solid_boundary.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac {
namespace {

using test::lambda, test::mu, test::Solid;

TEST(SolidBoundary, IsConstantUntilSomethingChanges) {
  const auto body = test::box_body<2>({6, 6}, 0.5);
  const auto constant = [&](auto&& change) {
    SolidBoundary<2> boundary(*body);
    boundary.roller(0, 0.1);
    boundary.fixed(2, {0.1, 0.2});
    boundary.body_force({0.0, -1.0});
    EXPECT_TRUE(boundary.is_constant());
    change(boundary);
    return boundary.is_constant();
  };
  const Schedule ramp = Schedule::ramp(1.0);
  EXPECT_TRUE(constant([](auto& b) { b.traction(3, {1.0, 0.0}); }));
  EXPECT_TRUE(constant([](auto& b) { b.gravity(2.0, {0.0, -9.81}); }));
  EXPECT_FALSE(constant([](auto& b) { b.roller(0, 0.0, 1.0); }));
  EXPECT_FALSE(constant([&](auto& b) { b.roller(0, 1.0, 0.0, ramp); }));
  EXPECT_FALSE(constant([](auto& b) { b.fixed(1, {}, {0.0, 1.0}); }));
  EXPECT_FALSE(constant([&](auto& b) { b.rigid_plate(3, 1.0, ramp); }));
  EXPECT_FALSE(constant([&](auto& b) { b.pressure(3, 1.0, ramp); }));
  EXPECT_FALSE(constant([&](auto& b) { b.body_force({1.0, 0.0}, ramp); }));
}

/// Under a traction on a ramp and between rollers on another, the body is linear at every time and
/// the energy is that of the moment.
TEST(SolidBoundary, FollowsItsSchedules) {
  Solid<2> solid(test::cube<2>(9));
  solid.boundary.roller(0, 0.0);
  solid.boundary.roller(2, 0.0);
  solid.boundary.roller(3, 0.045, 0.009, Schedule::ramp(4.0));
  solid.boundary.traction(1, {0.2, 0.0}, Schedule::table({1.0, 3.0}, {0.5, -1.0}));
  solid.start();
  const auto expect = [&](double strain_y, double stress_x) {
    const double strain_x = (stress_x - lambda * strain_y) / (lambda + 2.0 * mu);
    EXPECT_LT(solid.error({strain_x, strain_y}), 1e-12) << solid.time;
    const double energy = solid.energy_of({strain_x, strain_y});
    EXPECT_NEAR(solid.port("elastic_energy").value[0], energy, 1e-12 * energy) << solid.time;
    EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12) << solid.time;
  };
  solid.step(0.0);
  expect(0.0, 0.1);
  solid.step(0.5);
  expect(0.01 * 0.125 + 0.002 * 0.5, 0.1);
  solid.step(1.5);
  expect(0.01 * 0.5 + 0.002 * 2.0, -0.05);
  solid.step(7.0);
  expect(0.01 + 0.002 * 9.0, -0.2);
}

/// A constant and a scheduled boundary agree wherever the schedule's factor is 1.
TEST(SolidBoundary, EndsARampWhereAConstantLoadIs) {
  const auto displacement = [](const Schedule& schedule) {
    Solid<3> solid(test::cube<3>(8));
    solid.boundary.roller(4, 0.01, 0.0, schedule);
    solid.boundary.fixed(0, {0.01, 0.0, -0.02}, {}, schedule);
    solid.boundary.traction(1, {0.1, 0.2, 0.3}, schedule);
    solid.boundary.rigid_plate(5, 0.4, schedule);
    solid.boundary.body_force({0.0, 0.1, 0.0}, schedule);
    solid.start();
    solid.step(0.7);
    solid.step(0.3);
    const auto u = solid.port("displacement").value;
    return std::vector<double>(u.begin(), u.end());
  };
  const auto constant = displacement({}), ramped = displacement(Schedule::ramp(1.0));
  for (std::size_t i = 0; i < constant.size(); ++i) {
    ASSERT_NEAR(ramped[i], constant[i], 1e-13 * test::largest(constant));
  }
}

/// Change of elastic energy = external work, window by window, whatever moves and loads.
template <int D>
void expect_energy_balance_in_motion(int count) {
  Solid<D> solid(test::cube<D>(count));
  solid.boundary.fixed(0, {}, {0.01});
  solid.boundary.roller(2 * D - 2, 0.1, 0.0, Schedule::ramp(2.5));
  Vector<D> traction{};
  traction[0] = 0.3;
  traction[D - 1] = 0.2;
  solid.boundary.traction(2 * D - 1, traction, Schedule::table({0.0, 1.5, 3.0}, {0.2, 1.0, -1.0}));
  Vector<D> force{};
  force[0] = 0.05;
  solid.boundary.body_force(force, Schedule::ramp(3.5));
  solid.start();
  double elastic = 0.0, external = 0.0;
  for (const double length : {0.0, 1.0, 0.5, 1.0, 1.0}) {
    solid.step(length);
    const double elastic_now = solid.port("elastic_energy").value[0];
    const double external_now = solid.port("external_work").value[0];
    EXPECT_NEAR(elastic_now - elastic, external_now - external, 1e-12 * elastic_now);
    EXPECT_GT(std::abs(external_now - external), 1e-4 * elastic_now) << "no trivial balance";
    elastic = elastic_now;
    external = external_now;
  }
}

TEST(SolidBoundary, BalancesEnergyWhileItMoves) {
  expect_energy_balance_in_motion<2>(12);
  expect_energy_balance_in_motion<3>(8);
}

/// sigma_v = rho g depth, and the settlement of a column of elastic rock.
TEST(SolidBoundary, WeighsTheRock) {
  const double density = 2.0, g = 5.0;
  std::vector<double> settlement, stress;
  for (const int count : {10, 20, 40}) {
    Solid<2> solid({6, count}, 1.0 / count);
    for (const int face : {0, 1, 2}) solid.boundary.roller(face, 0.0);
    solid.boundary.gravity(density, {0.0, -g});
    auto elastic = test::elastic<2>(*solid.body, solid.boundary, {lambda, mu});
    solid.start();
    solid.step();
    const Index n = solid.points();
    const auto u = solid.port("displacement").value;
    std::vector<double> all(elastic->size(), 0.0), sigma(4 * n);
    std::ranges::copy(u, all.begin());  // its face values are 0
    elastic->stress(all, sigma);
    settlement.push_back(0.0);
    stress.push_back(0.0);
    for (Index i = 0; i < n; ++i) {
      const double y = solid.body->points().position[1][i];
      const double drop = -density * g * (y - 0.5 * y * y) / (lambda + 2.0 * mu);
      const double weight = density * g * (1.0 - y);
      settlement.back() = std::max(settlement.back(), std::abs(u[n + i] - drop));
      stress.back() = std::max(stress.back(), std::abs(sigma[3 * n + i] + weight));
    }
  }
  for (const int k : {1, 2}) {
    const double of_settlement = std::log2(settlement[k - 1] / settlement[k]);
    const double of_stress = std::log2(stress[k - 1] / stress[k]);
    RecordProperty("settlement_order_" + std::to_string(k), std::to_string(of_settlement));
    RecordProperty("stress_order_" + std::to_string(k), std::to_string(of_stress));
    EXPECT_GE(of_settlement, 1.9);
    EXPECT_GE(of_stress, 0.9);
  }
}

/// Under pressure a ball shrinks uniformly: held by its planes, as a module; whole, its load
/// balances the inner force of that state.
template <int D>
void expect_ball_shrinks_uniformly(double radius) {
  const double pressure = 0.3;
  Vector<D> slope;
  slope.fill(-pressure / (D * (lambda + 2.0 * mu / D)));

  Solid<D> part(test::ball_body<D>(radius, 1.0, true));
  for (int a = 0; a < D; ++a) part.boundary.roller(a, 0.0);
  part.boundary.pressure(D, pressure, Schedule::ramp(2.0));
  part.start();
  part.step();
  part.step();
  EXPECT_LT(part.error(slope), 1e-12);
  const double energy = part.energy_of(slope);
  EXPECT_NEAR(part.port("external_work").value[0], energy, 1e-12 * energy);

  const auto whole = test::ball_body<D>(radius, 1.0);
  SolidBoundary<D> boundary(*whole);
  boundary.pressure(0, pressure);
  const auto elastic = test::elastic<D>(*whole, boundary, {lambda, mu});
  const auto mirror = boundary.mirror_condition(*whole->family(0));
  Eigen::VectorXd load(elastic->size()), shrunk(elastic->size());
  boundary.loads(mirror, test::force_of(*elastic)).at(0.0, load);
  const Index n = whole->points().size();
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < n; ++i) shrunk[a * n + i] = slope[a] * whole->points().position[a][i];
  }
  EXPECT_LT(test::largest(elastic->assemble() * shrunk - load), 1e-12 * test::largest(load));
}

TEST(SolidBoundary, PressesOnABall) {
  expect_ball_shrinks_uniformly<2>(8.0);
  expect_ball_shrinks_uniformly<3>(6.0);
}

TEST(SolidBoundary, PressesOnAPlaneAgainstItsNormal) {
  const auto body = test::box_body<2>({12, 12}, 0.5);
  const auto load = [&](auto&& change) {
    SolidBoundary<2> boundary(*body);
    change(boundary);
    const auto elastic = test::elastic<2>(*body, boundary, {lambda, mu});
    Eigen::VectorXd load(elastic->size());
    boundary.loads(boundary.mirror_condition(*body->family(0)), test::force_of(*elastic))
        .at(0.0, load);
    return load;
  };
  EXPECT_EQ(load([](auto& b) { b.pressure(0, 0.3); }), load([](auto& b) {
              b.traction(0, {0.3, 0.0});
            }));
  EXPECT_EQ(load([](auto& b) { b.pressure(3, 0.3); }), load([](auto& b) {
              b.traction(3, {0.0, -0.3});
            }));
}

}  // namespace
}  // namespace perifrac
