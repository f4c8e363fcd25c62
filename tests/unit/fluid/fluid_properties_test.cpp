#include "modules/fluid/points/fluid_properties.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

const FluidProperties linear{.density = 1000.0, .bulk_modulus = 22e6, .viscosity = 1e-3};
const FluidProperties tait{
    .density = 1000.0, .bulk_modulus = 22e6, .viscosity = 1e-3, .tait_exponent = 7.0};

TEST(FluidProperties, PressureAndDensityAreInverse) {
  for (const FluidProperties& fluid : {linear, tait}) {
    EXPECT_EQ(fluid.pressure(fluid.density), 0.0);
    EXPECT_EQ(fluid.density_at(0.0), fluid.density);
    for (const double p : {-1e6, -10.0, 1e-3, 1e3, 1e5, 5e6, 1e8}) {
      EXPECT_NEAR(fluid.pressure(fluid.density_at(p)), p, 1e-12 * (22e6 + std::abs(p))) << p;
    }
  }
}

/// K = rho dp/drho at zero pressure; Tait's pressure at a known density.
TEST(FluidProperties, HaveTheirBulkModulus) {
  for (const FluidProperties& fluid : {linear, tait}) {
    const double step = 1e-3;
    const double slope =
        (fluid.pressure(1000.0 + step) - fluid.pressure(1000.0 - step)) / (2 * step);
    EXPECT_NEAR(slope * 1000.0, 22e6, 1e-6 * 22e6);
  }
  EXPECT_NEAR(tait.pressure(1100.0), 22e6 / 7.0 * (std::pow(1.1, 7.0) - 1.0), 1e-6);
  EXPECT_NEAR(linear.pressure(1100.0), 2.2e6, 1e-6);
}

TEST(FluidProperties, SoundSpeedIsTheSlopeOfPressure) {
  for (const FluidProperties& fluid : {linear, tait}) {
    for (const double rho : {980.0, 1000.0, 1150.0}) {
      const double step = 1e-3;
      const double slope = (fluid.pressure(rho + step) - fluid.pressure(rho - step)) / (2 * step);
      EXPECT_NEAR(fluid.sound_speed(rho), std::sqrt(slope), 1e-6 * std::sqrt(slope)) << rho;
    }
    EXPECT_EQ(fluid.sound_speed(), fluid.sound_speed(fluid.density));
  }
}

/// The work that compresses a kilogram, p d(-1/rho).
TEST(FluidProperties, ElasticEnergyIsTheIntegralOfPressure) {
  for (const FluidProperties& fluid : {linear, tait}) {
    EXPECT_EQ(fluid.elastic_energy(fluid.density), 0.0);
    for (const double rho : {980.0, 1000.1, 1150.0}) {
      const double step = 1e-3;
      const double slope =
          (fluid.elastic_energy(rho + step) - fluid.elastic_energy(rho - step)) / (2 * step);
      const double exact = fluid.pressure(rho) / (rho * rho);
      EXPECT_NEAR(slope, exact, 1e-6 * std::abs(exact)) << rho;
    }
    // Just above its density at rest, p^2 / 2K of a unit volume.
    const double p = 22.0;
    EXPECT_NEAR(fluid.elastic_energy(fluid.density_at(p)) * 1000.0, p * p / (2 * 22e6),
                1e-5 * p * p / (2 * 22e6));
  }
}

/// Against dp/dphi = rho(p) integrated in many small steps (fourth order).
TEST(FluidProperties, DensityBelowIsThatOfFluidAtRest) {
  for (const FluidProperties& fluid : {linear, tait}) {
    for (const double surface : {0.0, 1e5}) {
      for (const double potential : {9.81 * 20.0, 9.81 * 500.0, -9.81 * 2.0}) {
        double p = surface;
        const int steps = 2000;
        const double h = potential / steps;
        const auto rho = [&](double pressure) { return fluid.density_at(pressure); };
        for (int n = 0; n < steps; ++n) {
          const double k1 = rho(p), k2 = rho(p + 0.5 * h * k1), k3 = rho(p + 0.5 * h * k2),
                       k4 = rho(p + h * k3);
          p += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
        }
        const double below = fluid.density_below(fluid.density_at(surface), potential);
        EXPECT_NEAR(below, fluid.density_at(p), 1e-11 * below) << surface << ' ' << potential;
      }
    }
  }
}

}  // namespace
}  // namespace perifrac
