#include "app/references/solutions/terzaghi_solution.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// K = 5 GPa, G = 4 GPa, phi = 0.306, K_f = 2.2 GPa.
const TerzaghiProblem column{.uniaxial_modulus = 5e9 + 4.0 / 3.0 * 4e9,
                             .biot_coefficient = 1.0,
                             .storage = 0.306 / 2.2e9,
                             .mobility = 1.02e-8,
                             .height = 50.0,
                             .load = 14.624e6};

TEST(TerzaghiSolution, ConstantsOfTheColumn) {
  const TerzaghiSolution terzaghi(column);
  EXPECT_NEAR(terzaghi.consolidation_coefficient(), 43.245, 5e-4);
  EXPECT_NEAR(terzaghi.initial_pressure(), 6e6, 300.0);
  EXPECT_NEAR(terzaghi.final_settlement(), 14.624e6 * 50.0 / 10.3333e9, 1e-6);
}

TEST(TerzaghiSolution, IsUndrainedAtFirstAndDrainedAtLast) {
  const TerzaghiSolution terzaghi(column);
  // Undrained: no fluid content anywhere, alpha theta + S p = 0.
  const double strain = terzaghi.displacement(50.0, 0.0) / 50.0;
  EXPECT_NEAR(strain + column.storage * terzaghi.pressure(20.0, 0.0), 0.0, 1e-15);
  EXPECT_NEAR(terzaghi.displacement(50.0, 1e5), -terzaghi.final_settlement(), 1e-12);
  EXPECT_NEAR(terzaghi.pressure(50.0, 3.0), 0.0, 1e-7);
}

/// With a Biot coefficient below 1, so that it cannot be left out anywhere.
TEST(TerzaghiSolution, KeepsEquilibriumAndFluidMassEverywhere) {
  TerzaghiProblem problem = column;
  problem.biot_coefficient = 0.7;
  const TerzaghiSolution terzaghi(problem);
  const double dz = 1e-3;
  const auto strain = [&](double z, double t) {
    return (terzaghi.displacement(z + dz, t) - terzaghi.displacement(z - dz, t)) / (2.0 * dz);
  };
  const auto content = [&](double z, double t) {
    return problem.biot_coefficient * strain(z, t) + problem.storage * terzaghi.pressure(z, t);
  };
  for (const double t : {0.3, 3.0, 30.0}) {
    for (const double z : {2.0, 25.0, 45.0}) {
      const double p = terzaghi.pressure(z, t);
      EXPECT_NEAR(problem.uniaxial_modulus * strain(z, t) - problem.biot_coefficient * p,
                  -problem.load, 1e-6 * problem.load);
      const double dt = 1e-3 * t;
      const double h = 0.05;
      const double gained = (content(z, t + dt) - content(z, t - dt)) / (2.0 * dt);
      const double came = problem.mobility *
                          (terzaghi.pressure(z + h, t) - 2.0 * p + terzaghi.pressure(z - h, t)) /
                          (h * h);
      EXPECT_NEAR(gained, came, 1e-3 * problem.storage * terzaghi.initial_pressure() / t);
    }
  }
}

}  // namespace
}  // namespace perifrac
