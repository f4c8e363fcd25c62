#include "modules/solid/boundary/interface_force.hpp"

#include <numeric>

#include <gtest/gtest.h>

#include "core/operators/face_load.hpp"
#include "tests/unit/solid/layered_box.hpp"
#include "tests/unit/solid/moving_solid.hpp"

namespace perifrac {
namespace {

using test::Moving;
using test::Solid;

/// The impulse of a uniform traction along the first axis on face 1 over `length` [s].
template <int D>
std::vector<double> impulse_of_traction(const Body<D>& body, const SolidBoundary<D>& boundary,
                                        double traction, double length) {
  const auto family = body.family(boundary.mirrored());
  const LinearExactOperator<D, IsotropicElasticity<D>> op(
      family, boundary.mirror_condition(*family), {test::lambda, test::mu});
  const Eigen::VectorXd load =
      length * traction * face_load<D, D>(body, test::force_of(op), boundary.mirrored(), 1, 0);
  std::vector<double> impulse(D * body.points().size(), 0.0);
  std::ranges::copy(load, impulse.begin());
  return impulse;
}

/// A bar between rollers, pulled at its end by an impulse: the stress is the traction's, uniaxial
/// strain along it.
template <int D>
void expect_patch(const std::array<int, D>& counts) {
  Solid<D> solid(counts);
  for (int face = 0; face < 2 * D; ++face) {
    if (face != 1) solid.boundary.roller(face, 0.0);
  }
  solid.start();
  Vector<D> slope{};
  slope[0] = 0.01;
  const double length = 0.4;
  const auto impulse =
      impulse_of_traction<D>(*solid.body, solid.boundary, solid.stress(slope)[0], length);
  std::ranges::copy(impulse, solid.port("interface_impulse").value.begin());
  solid.step(length);
  EXPECT_LT(solid.error(slope), 1e-12);
  const double energy = solid.energy_of(slope);
  EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy);

  std::ranges::fill(solid.port("interface_impulse").value, 7.0);
  solid.step(0.0);
  EXPECT_LT(solid.error(slope), 1e-12) << "a window of no length has no impulse";
  std::ranges::fill(solid.port("interface_impulse").value, 0.0);
  solid.step(0.3);
  EXPECT_NEAR(solid.port("elastic_energy").value[0], 0.0, 1e-13 * energy);
  EXPECT_NEAR(solid.port("external_work").value[0], 0.0, 1e-13 * energy) << "given back";
}

TEST(InterfaceForce, PullsABarAsATractionDoes) {
  expect_patch<2>({10, 7});
  expect_patch<3>({8, 6, 6});
}

TEST(InterfaceForce, GoesIntoTheReactionWhereADisplacementIsPrescribed) {
  Solid<2> still(test::layered_box<2>({8, 7}, 0.5, {0}));
  Moving<2> moving(still.body);
  for (SolidBoundary<2>* boundary : {&still.boundary, &moving.boundary}) {
    boundary->fixed(0, {0.0, 0.0});
  }
  still.start();
  moving.start();
  for (const Index i : still.body->layer(0)) {
    still.port("interface_impulse").value[i] = 3.0;
    moving.port("interface_impulse").value[i] = 3.0;
  }
  still.step();
  moving.advance(1.0);
  for (const double u : still.port("displacement").value) EXPECT_EQ(u, 0.0);
  for (const double u : moving.port("displacement").value) EXPECT_EQ(u, 0.0);
  EXPECT_EQ(still.port("external_work").value[0], 0.0);
  EXPECT_EQ(moving.value("external_work"), 0.0);
}

TEST(InterfaceForce, OfAnyKindDoesTheWorkThatTheQuasiStaticSolidStores) {
  Solid<2> solid({9, 7});
  solid.boundary.fixed(0, {});
  solid.boundary.rigid_plate(3, 0.2);
  solid.start();
  for (unsigned window = 1; window <= 5; ++window) {
    const auto impulse = solid.port("interface_impulse").value;
    std::ranges::copy(test::random_values(impulse.size(), window), impulse.begin());
    solid.step(0.1 * window);
    const double energy = solid.port("elastic_energy").value[0];
    EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy);
  }
}

TEST(InterfaceForce, GivesAFreeBodyExactlyItsImpulse) {
  Moving<3> solid(test::ball_body<3>(2.0, 0.5));
  solid.start();
  const Index n = solid.body->points().size();
  Vector<3> given{};
  for (unsigned window = 1; window <= 20; ++window) {
    const auto impulse = solid.port("interface_impulse").value;
    std::ranges::copy(test::random_values(impulse.size(), window), impulse.begin());
    for (int a = 0; a < 3; ++a) {
      given[a] = std::accumulate(impulse.begin() + a * n, impulse.begin() + (a + 1) * n, given[a]);
    }
    solid.advance((window % 3 + 0.1) * solid.module->stable_time_step());
  }
  const auto v = solid.port("velocity").value;
  for (int a = 0; a < 3; ++a) {
    double momentum = 0.0;
    for (Index i = 0; i < n; ++i) {
      momentum += test::density * solid.body->points().volume[i] * v[a * n + i];
    }
    EXPECT_NEAR(momentum, given[a], 1e-12 * n);
    EXPECT_GT(std::abs(given[a]), 1.0);
  }
}

/// Impulses of a force that swings, in windows of several steps.
double energy_error(double safety) {
  Moving<2> solid({9, 7});
  solid.safety = safety;
  solid.boundary.roller(0, 0.0);
  solid.boundary.roller(2, 0.0);
  solid.start();
  const double length = 1.0;
  double worst = 0.0, largest = 0.0;
  for (int window = 0; window < 40; ++window) {
    const auto impulse =
        impulse_of_traction<2>(*solid.body, solid.boundary, 0.1 * std::sin(0.4 * window), length);
    std::ranges::copy(impulse, solid.port("interface_impulse").value.begin());
    solid.advance(length);
    worst = std::max(worst, std::abs(solid.energy_error()));
    largest = std::max(largest, solid.value("elastic_energy"));
  }
  return worst / largest;
}

TEST(InterfaceForce, ClosesTheDynamicSolidsEnergyWithTheSquareOfTheStep) {
  const double coarse = energy_error(0.2), fine = energy_error(0.1);
  EXPECT_LT(fine, 3e-3);
  EXPECT_GT(coarse / fine, 3.6);
}

TEST(InterfaceForce, BringsTheDampedDynamicSolidWhereTheQuasiStaticIs) {
  const auto body = test::box_body<2>({9, 11}, 0.5);
  Moving<2> moving(body);
  Solid<2> still(body);
  moving.damping = 1.0;
  for (SolidBoundary<2>* boundary : {&still.boundary, &moving.boundary}) {
    boundary->fixed(0, {});
    boundary->traction(3, {0.0, 0.05}, Schedule::ramp(2.0));
  }
  moving.start();
  still.start();
  const std::vector<double> impulse = test::random_values(2 * body->points().size());
  for (int window = 0; window < 60; ++window) {
    std::ranges::copy(impulse, moving.port("interface_impulse").value.begin());
    moving.advance(5.0);
  }
  std::ranges::copy(impulse, still.port("interface_impulse").value.begin());
  still.step(5.0);
  const auto u = moving.port("displacement").value, expected = still.port("displacement").value;
  for (std::size_t k = 0; k < u.size(); ++k) {
    EXPECT_NEAR(u[k], expected[k], 1e-6 * test::largest(expected));
  }
}

}  // namespace
}  // namespace perifrac
