#include "app/references/solutions/slab_inflow.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

using slab_inflow::inflow;
using slab_inflow::inflow_integral;
using slab_inflow::value;
using slab_inflow::value_integral;

TEST(SlabInflow, ObeysDiffusionAndItsBoundaryConditions) {
  // 0.19 and 0.21: by images and by the series.
  for (const double T : {1e-3, 0.01, 0.1, 0.19, 0.21, 0.5, 2.0}) {
    const double h = 1e-3 * std::min(1.0, std::sqrt(T) * 3.0);
    const double dt = 1e-3 * T;
    for (const double xi : {0.05, 0.3, 0.7, 0.95}) {
      const double rate = (value(xi, T + dt) - value(xi, T - dt)) / (2.0 * dt);
      const double curvature = (value(xi + h, T) - 2.0 * value(xi, T) + value(xi - h, T)) / (h * h);
      EXPECT_NEAR(rate, curvature, 3e-5 / T) << T << ' ' << xi;
    }
    EXPECT_NEAR(value(0.0, T), 0.0, 1e-14);
    EXPECT_NEAR(value(1.0, T), 1.0, 1e-14);
    // One-sided, of third order.
    const double gradient = (11.0 * value(1.0, T) - 18.0 * value(1.0 - h, T) +
                             9.0 * value(1.0 - 2.0 * h, T) - 2.0 * value(1.0 - 3.0 * h, T)) /
                            (6.0 * h);
    EXPECT_NEAR((inflow(T + dt) - inflow(T - dt)) / (2.0 * dt), gradient, 1e-5 * gradient) << T;
  }
}

TEST(SlabInflow, IntegralsAreThoseOfTheirRates) {
  for (const double T : {1e-3, 0.01, 0.1, 0.19, 0.21, 0.5, 2.0}) {
    const double dt = 1e-3 * T;
    for (const double xi : {0.3, 0.7, 0.95}) {
      EXPECT_NEAR((value_integral(xi, T + dt) - value_integral(xi, T - dt)) / (2.0 * dt),
                  value(xi, T), 1e-5)
          << T << ' ' << xi;
    }
    EXPECT_NEAR((inflow_integral(T + dt) - inflow_integral(T - dt)) / (2.0 * dt), inflow(T),
                1e-6 * inflow(T))
        << T;
  }
  for (const double xi : {0.3, 0.7}) EXPECT_NEAR(value_integral(xi, 1e-5), 0.0, 1e-16);
  EXPECT_EQ(inflow_integral(0.0), 0.0);
}

TEST(SlabInflow, ImagesAndSeriesAgreeWhereTheyMeet) {
  const double later = std::nextafter(0.2, 1.0);
  for (const double xi : {0.1, 0.4, 0.9}) {
    EXPECT_NEAR(value(xi, 0.2), value(xi, later), 1e-14);
    EXPECT_NEAR(value_integral(xi, 0.2), value_integral(xi, later), 1e-14);
  }
  EXPECT_NEAR(inflow(0.2), inflow(later), 1e-14);
  EXPECT_NEAR(inflow_integral(0.2), inflow_integral(later), 1e-14);
}

TEST(SlabInflow, StartsAsAHalfSpaceAndEndsSteady) {
  EXPECT_NEAR(inflow(1e-4), std::sqrt(4e-4 / M_PI), 1e-16);
  EXPECT_NEAR(value(0.99, 1e-4), std::erfc(0.5), 1e-15);
  EXPECT_NEAR(value(0.4, 10.0), 0.4, 1e-14);
  EXPECT_NEAR(inflow(11.0) - inflow(10.0), 1.0, 1e-13);
  EXPECT_NEAR(inflow(10.0), 10.0 + 1.0 / 3.0, 1e-13) << "what fills the slab: a third comes extra";
}

}  // namespace
}  // namespace perifrac
