#include <cmath>
#include <cstdio>
#include <numeric>

#include <gtest/gtest.h>

#include "modules/fluid/bond_flux_exchange.hpp"
#include "modules/fluid/fluid_dynamics.hpp"
#include "modules/fluid/two_sided_wall_force.hpp"
#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

TEST(Draining, Explore) {
  test::FluidOverBody<2> scene(12, 4, 0.1);
  const double K = 2e4;
  FluidProperties fluid{.density = 1000.0, .bulk_modulus = K, .viscosity = 1e-3};
  FluidScheme scheme = scene.scheme;
  scheme.merge_below = 0.1;
  const Vector<2> gravity{0.0, -9.81};
  auto period = test::FluidOverBody<2>::make_period(1.2);
  auto exchange = std::make_unique<BondFluxExchange<2>>(*scene.body, scene.cloud, scene.rigid, period, scheme.horizon);
  FluidPoints<2> points = scene.points;
  for (Index i = 0; i < points.count; ++i) {
    points.density[i] = fluid.density_below(1000.0, 9.81 * (0.4 - points.position[1][i]));
    points.mass[i] = points.density[i] * 0.01;
  }
  FluidDynamics<2> dynamics(fluid, scheme, gravity, period, points, scene.cloud, {}, scene.body->points().size(),
                            std::make_unique<TwoSidedWallForce<2>>(), std::move(exchange));
  scene.mobility.assign(scene.mobility.size(), 5e-7);
  double given = 0.0, start = std::accumulate(points.mass.begin(), points.mass.end(), 0.0);
  double t = 0.0;
  for (int w = 0; w < 6000 && dynamics.points().count > 0; ++w) {
    dynamics.set_pores({scene.pressure, scene.rate, scene.mobility, t});
    dynamics.start_totals();
    const double end = t + 0.01;
    int steps = 0;
    while (t < end - 1e-12) {
      const double dt = std::min(dynamics.longest_step(t), end - t);
      dynamics.step(t, dt);
      t += dt;
      ++steps;
    }
    given += std::accumulate(dynamics.exchanged_mass().begin(), dynamics.exchanged_mass().end(), 0.0);
    const auto& p = dynamics.points();
    const double free = std::accumulate(p.mass.begin(), p.mass.end(), 0.0);
    double pmax = 0, ymin = 1e9, vmax = 0;
    for (Index i = 0; i < p.count; ++i) {
      pmax = std::max(pmax, fluid.pressure(p.density[i]));
      ymin = std::min(ymin, p.position[1][i]);
      vmax = std::max(vmax, std::hypot(p.velocity[0][i], p.velocity[1][i]));
    }
    if (w % 200 == 0)
      std::printf("t %.3g steps %d n %d free %.4g of %.4g err %.2e merged %ld pmax %.3g ymin %.3g vmax %.2g minm %.2g\n", t, steps, p.count, free, start,
                  (free + given - start) / start, dynamics.merged(), pmax, ymin, vmax, p.count ? *std::ranges::min_element(p.mass) : 0.0);
  }
}

}  // namespace
}  // namespace perifrac
