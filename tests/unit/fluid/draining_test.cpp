#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "modules/fluid/exchange/bond_flux_exchange.hpp"
#include "modules/fluid/fluid_dynamics.hpp"
#include "modules/fluid/semi_lagrangian/semi_lagrangian_method.hpp"
#include "modules/fluid/walls/two_sided_wall_force.hpp"
#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

/// What the fluid has and has given away: mass, then momentum.
template <int D>
struct Account {
  double mass = 0.0;
  Vector<D> momentum{};

  void add(const FluidPoints<D>& points) {
    for (Index i = 0; i < points.count; ++i) {
      mass += points.mass[i];
      for (int a = 0; a < D; ++a) momentum[a] += points.mass[i] * points.velocity[a][i];
    }
  }
  void add(const FluidDynamics<D>& dynamics) {
    for (const double given : dynamics.exchanged_mass()) mass += given;
    const std::size_t count = dynamics.exchanged_mass().size();
    for (std::size_t k = 0; k < D * count; ++k) momentum[k / count] += dynamics.impulse()[k];
  }
};

/// Water, `across` points wide and `high` points high, over pores that a drain keeps at no
/// pressure, until nothing is left of it.
template <int D>
void expect_drains_wholly(int across, int high) {
  test::FluidOverBody<D> scene(across, high, 0.1);
  const FluidProperties fluid{.density = 1000.0, .bulk_modulus = 2e4, .viscosity = 1e-3};
  scene.scheme.merge_below = 0.1;
  Vector<D> gravity{};
  gravity[D - 1] = -9.81;
  const double top = 0.1 * high;
  for (Index i = 0; i < scene.points.count; ++i) {
    scene.points.density[i] =
        fluid.density_below(1000.0, 9.81 * (top - scene.points.position[D - 1][i]));
    scene.points.mass[i] *= scene.points.density[i] / 1000.0;
    scene.points.velocity[0][i] = 0.2;
  }
  const auto period = test::FluidOverBody<D>::make_period(0.1 * across);
  Vector<D> low, far;
  low.fill(-9.0);
  far.fill(9.0);
  FluidDynamics<D> dynamics(
      fluid, scene.scheme,
      std::get<FluidMethodType::Maker<D>>(semi_lagrangian_method().make)(scene.scheme), gravity,
      period, scene.points, scene.cloud, {}, scene.body->points().size(),
      {.inlets = nullptr, .outlets = nullptr, .domain = FluidDomain<D>({"all", low, far}, 0)},
      std::make_unique<TwoSidedWallForce<D>>(),
      std::make_unique<BondFluxExchange<D>>(*scene.body, scene.cloud, scene.rigid, period,
                                            scene.scheme.horizon, scene.influence));
  scene.mobility.assign(scene.mobility.size(), 2e-5);
  dynamics.start_totals();
  dynamics.set_pores(scene.pores());

  Account<D> start;
  start.add(dynamics.points());
  double weight = 0.0;  // times time
  for (double t = 0.0; t < 10.0 && dynamics.points().count > 0;) {
    const double length = dynamics.longest_step(t);
    dynamics.step(t, length);
    t += length;
    for (const double mass : dynamics.points().mass) weight += length * mass * 9.81;
  }
  EXPECT_EQ(dynamics.points().count, 0);
  EXPECT_GT(dynamics.merged(), scene.points.count / 2);
  Account<D> end;
  end.add(dynamics);
  EXPECT_NEAR(end.mass, start.mass, 1e-12 * start.mass);
  for (int a = 0; a < D; ++a) {
    const double pulled = a == D - 1 ? -weight : 0.0;
    EXPECT_NEAR(end.momentum[a], start.momentum[a] + pulled, 1e-12 * weight);
  }
}

TEST(Draining, LosesNothingUntilNothingIsLeft) {
  expect_drains_wholly<2>(20, 6);
  expect_drains_wholly<3>(6, 2);
}

}  // namespace
}  // namespace perifrac
