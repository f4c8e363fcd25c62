#include "app/references/solutions/slab_inflow.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(SlabInflow, ObeysDiffusionAndItsBoundaryConditions) {
  // 0.19 and 0.21: by images and by the series.
  for (const double T : {1e-3, 0.01, 0.1, 0.19, 0.21, 0.5, 2.0}) {
    const double h = 1e-3 * std::min(1.0, std::sqrt(T) * 3.0);
    const double dt = 1e-3 * T;
    for (const double xi : {0.05, 0.3, 0.7, 0.95}) {
      const double rate =
          (slab_inflow::value(xi, T + dt) - slab_inflow::value(xi, T - dt)) / (2.0 * dt);
      const double curvature = (slab_inflow::value(xi + h, T) - 2.0 * slab_inflow::value(xi, T) +
                                slab_inflow::value(xi - h, T)) /
                               (h * h);
      EXPECT_NEAR(rate, curvature, 3e-5 / T) << T << ' ' << xi;
    }
    EXPECT_NEAR(slab_inflow::value(0.0, T), 0.0, 1e-14);
    EXPECT_NEAR(slab_inflow::value(1.0, T), 1.0, 1e-14);
    // One-sided, of third order.
    const double gradient =
        (11.0 * slab_inflow::value(1.0, T) - 18.0 * slab_inflow::value(1.0 - h, T) +
         9.0 * slab_inflow::value(1.0 - 2.0 * h, T) - 2.0 * slab_inflow::value(1.0 - 3.0 * h, T)) /
        (6.0 * h);
    EXPECT_NEAR((slab_inflow::inflow(T + dt) - slab_inflow::inflow(T - dt)) / (2.0 * dt), gradient,
                1e-5 * gradient)
        << T;
  }
}

TEST(SlabInflow, IntegralsAreThoseOfTheirRates) {
  for (const double T : {1e-3, 0.01, 0.1, 0.19, 0.21, 0.5, 2.0}) {
    const double dt = 1e-3 * T;
    for (const double xi : {0.3, 0.7, 0.95}) {
      EXPECT_NEAR(
          (slab_inflow::value_integral(xi, T + dt) - slab_inflow::value_integral(xi, T - dt)) /
              (2.0 * dt),
          slab_inflow::value(xi, T), 1e-5)
          << T << ' ' << xi;
    }
    EXPECT_NEAR(
        (slab_inflow::inflow_integral(T + dt) - slab_inflow::inflow_integral(T - dt)) / (2.0 * dt),
        slab_inflow::inflow(T), 1e-6 * slab_inflow::inflow(T))
        << T;
  }
  for (const double xi : {0.3, 0.7}) EXPECT_NEAR(slab_inflow::value_integral(xi, 1e-5), 0.0, 1e-16);
  EXPECT_EQ(slab_inflow::inflow_integral(0.0), 0.0);
}

TEST(SlabInflow, ImagesAndSeriesAgreeWhereTheyMeet) {
  const double later = std::nextafter(0.2, 1.0);
  for (const double xi : {0.1, 0.4, 0.9}) {
    EXPECT_NEAR(slab_inflow::value(xi, 0.2), slab_inflow::value(xi, later), 1e-14);
    EXPECT_NEAR(slab_inflow::value_integral(xi, 0.2), slab_inflow::value_integral(xi, later),
                1e-14);
  }
  EXPECT_NEAR(slab_inflow::inflow(0.2), slab_inflow::inflow(later), 1e-14);
  EXPECT_NEAR(slab_inflow::inflow_integral(0.2), slab_inflow::inflow_integral(later), 1e-14);
}

TEST(SlabInflow, StartsAsAHalfSpaceAndEndsSteady) {
  EXPECT_NEAR(slab_inflow::inflow(1e-4), std::sqrt(4e-4 / M_PI), 1e-16);
  EXPECT_NEAR(slab_inflow::value(0.99, 1e-4), std::erfc(0.5), 1e-15);
  EXPECT_NEAR(slab_inflow::value(0.4, 10.0), 0.4, 1e-14);
  EXPECT_NEAR(slab_inflow::inflow(11.0) - slab_inflow::inflow(10.0), 1.0, 1e-13);
  EXPECT_NEAR(slab_inflow::inflow(10.0), 10.0 + 1.0 / 3.0, 1e-13)
      << "what fills the slab: a third comes extra";
}

}  // namespace
}  // namespace perifrac
