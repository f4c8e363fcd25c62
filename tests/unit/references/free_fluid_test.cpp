#include "app/references/free_fluid.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

FreeFluid soft_fluid(double tait_exponent) {
  return {.density = 1000.0,
          .bulk_modulus = 1e5,
          .tait_exponent = tait_exponent,
          .viscosity = 1e-3,
          .spacing = 0.1};
}

TEST(FreeFluid, AtRestBearsItsOwnWeight) {
  for (const double gamma : {1.0, 1.4, 7.0}) {
    const FreeFluid fluid = soft_fluid(gamma);
    const auto density = [&](double p) {
      return fluid.density * std::pow(1.0 + gamma * p / fluid.bulk_modulus, 1.0 / gamma);
    };
    // dp/d(depth) = density g by the classical Runge-Kutta method.
    constexpr double g = 9.81;
    constexpr int steps = 200;
    const double h = 3.0 / steps;
    double p = 0.0;
    for (int n = 0; n < steps; ++n) {
      const double k1 = g * density(p);
      const double k2 = g * density(p + 0.5 * h * k1);
      const double k3 = g * density(p + 0.5 * h * k2);
      const double k4 = g * density(p + h * k3);
      p += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    EXPECT_NEAR(fluid.pressure_at_rest(3.0, g), p, 1e-9 * p) << gamma;
  }
}

TEST(FreeFluid, HardlyCompressedHasALinearPressure) {
  FreeFluid fluid = soft_fluid(7.0);
  fluid.bulk_modulus = 2.2e9;
  EXPECT_NEAR(fluid.pressure_at_rest(10.0, 9.81), 98.1e3, 3.0);
  EXPECT_EQ(fluid.pressure_at_rest(0.0, 9.81), 0.0);
}

}  // namespace
}  // namespace perifrac
