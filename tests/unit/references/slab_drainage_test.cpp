#include "app/references/solutions/slab_drainage.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

using slab_drainage::integral;
using slab_drainage::value;

TEST(SlabDrainage, ObeysDiffusionAndItsBoundaryConditions) {
  // 0.19 and 0.21: by images and by the series.
  for (const double T : {1e-3, 0.01, 0.1, 0.19, 0.21, 0.5, 2.0}) {
    const double h = 1e-3 * std::min(1.0, std::sqrt(T) * 3.0);
    const double dt = 1e-3 * T;
    const double scale = value(0.0, T) / T;
    for (const double xi : {0.05, 0.3, 0.7, 0.95}) {
      const double rate = (value(xi, T + dt) - value(xi, T - dt)) / (2.0 * dt);
      const double curvature = (value(xi + h, T) - 2.0 * value(xi, T) + value(xi - h, T)) / (h * h);
      EXPECT_NEAR(rate, curvature, 3e-5 * scale) << T << ' ' << xi;
      EXPECT_NEAR((integral(xi + h, T) - integral(xi - h, T)) / (2.0 * h), value(xi, T), 1e-5)
          << T << ' ' << xi;
    }
    EXPECT_NEAR(value(1.0, T), 0.0, 1e-14);
    EXPECT_NEAR(value(h, T), value(-h, T), 1e-14) << "flux through the sealed end";
    EXPECT_NEAR(integral(0.0, T), 0.0, 1e-14);
  }
}

TEST(SlabDrainage, ImagesAndSeriesAgreeWhereTheyMeet) {
  const double later = std::nextafter(0.2, 1.0);
  for (const double xi : {0.0, 0.4, 0.9}) {
    EXPECT_NEAR(value(xi, 0.2), value(xi, later), 1e-14);
    EXPECT_NEAR(integral(xi, 0.2), integral(xi, later), 1e-14);
  }
}

TEST(SlabDrainage, StartsUniformAndKnowsTheTabulatedDegreesOfConsolidation) {
  EXPECT_EQ(value(0.5, 0.0), 1.0);
  EXPECT_NEAR(value(0.5, 1e-4), 1.0, 1e-14);
  EXPECT_NEAR(1.0 - integral(1.0, 1e-6), std::sqrt(4e-6 / M_PI), 1e-12);
  // Degrees of consolidation 50 and 90 % in every textbook: T = 0.197 and 0.848.
  EXPECT_NEAR(1.0 - integral(1.0, 0.197), 0.50, 5e-4);
  EXPECT_NEAR(1.0 - integral(1.0, 0.848), 0.90, 1e-4);
}

}  // namespace
}  // namespace perifrac
