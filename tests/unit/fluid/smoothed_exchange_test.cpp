#include "modules/fluid/as_published/smoothed_exchange.hpp"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "modules/fluid/exchange/bond_flux_exchange.hpp"
#include "tests/unit/fluid/fluid_over_body.hpp"

namespace perifrac {
namespace {

using test::FluidOverBody;

TEST(SmoothedExchange, LeaksWhateverThePermeability) {
  FluidOverBody<2> scene(6, 4, 0.5, 0.2);
  scene.mobility.assign(scene.mobility.size(), 0.0);
  scene.prepare([](const Vector<2>& x) { return 2e4 + 3e3 * x[0]; });
  const double horizon = scene.scheme.horizon;
  auto tight = std::make_unique<BondFluxExchange<2>>(*scene.body, scene.cloud, scene.rigid,
                                                     FluidOverBody<2>::make_period(3.0), horizon,
                                                     scene.influence);
  SmoothedExchange<2> exchange(std::move(tight), 0.25, 0.5, horizon, scene.influence);
  EXPECT_TRUE(exchange.keeps_mass());
  const std::vector<double> rate = scene.find(exchange);

  double weights = 0.0;  // about a point of a lattice
  for (int m = -3; m <= 3; ++m) {
    for (int n = -3; n <= 3; ++n) {
      const double square = 0.25 * (m * m + n * n);
      if (square > 0.0) weights += 0.25 * scene.influence(square);
    }
  }
  const double speed = std::sqrt(2e7 / 1000.0);
  double all = 0.0;
  for (Index i = 0; i < scene.points.count; ++i) {
    const Vector<2> x = scene.points.at(i);
    double near = 0.0;
    for (Index j = 0; j < scene.body->points().size(); ++j) {
      for (int k = -1; k <= 1; ++k) {
        const Vector<2> y = scene.body->points().at(j);
        near +=
            0.25 * scene.influence(std::pow(y[0] + 3.0 * k - x[0], 2) + std::pow(y[1] - x[1], 2));
      }
    }
    const double excess = 1000.0 * scene.points.pressure[i] / 2e7;  // of density
    const double exact = -0.25 * speed / 0.5 * excess * scene.points.volume[i] * near / weights;
    EXPECT_NEAR(rate[i], exact, 1e-12 * std::abs(exact)) << i;
    all += rate[i];
  }
  const double gained =
      std::accumulate(scene.walls.mass_rate.begin(), scene.walls.mass_rate.end(), 0.0);
  EXPECT_GT(gained, 0.0);
  EXPECT_NEAR(all + gained, 0.0, 1e-13 * gained);
}

}  // namespace
}  // namespace perifrac
