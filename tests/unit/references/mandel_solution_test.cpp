#include "app/references/solutions/mandel_solution.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// The paper's Table 1.
const MandelProblem table_1{.lame_lambda = 4e8,
                            .shear_modulus = 4e8,
                            .biot_coefficient = 1.0,
                            .storage = 0.3 / 2e9 + 0.7 / 1e10,
                            .mobility = 1e-4 / 9810.0,
                            .half_width = 40.0,
                            .half_height = 20.0,
                            .force = 1e4};

TEST(MandelSolution, ConstantsOfThePaper) {
  const MandelSolution mandel(table_1);
  EXPECT_NEAR(mandel.undrained_poisson_ratio(), 0.462585, 1e-6);
  EXPECT_NEAR(mandel.skempton_coefficient(), 0.872093, 1e-6);
  EXPECT_NEAR(mandel.initial_pressure(), 106.29, 5e-3);
  EXPECT_NEAR(mandel.consolidation_coefficient(), 9.6775, 5e-5);
}

TEST(MandelSolution, PressuresComputedElsewhere) {
  const MandelSolution mandel(table_1);
  const double time[] = {1, 5, 10, 20, 50, 100, 200};
  const double expected[3][7] = {{1.02537, 1.05581, 1.05127, 0.97470, 0.70477, 0.40093, 0.12964},
                                 {1.02536, 1.01499, 0.92629, 0.78596, 0.54650, 0.31054, 0.10042},
                                 {1.00209, 0.73715, 0.58284, 0.45134, 0.30223, 0.17155, 0.05547}};
  for (int place = 0; place < 3; ++place) {
    for (int n = 0; n < 7; ++n) {
      const double p = mandel.pressure(10.0 * (place + 1), time[n]) / mandel.initial_pressure();
      EXPECT_NEAR(p, expected[place][n], 5.1e-6);
    }
  }
  EXPECT_NEAR(mandel.peak_pressure(0.0) / mandel.initial_pressure(), 1.0756, 6e-5);
}

/// Pressure obeys p_t = c p_xx + f(t): the coupling adds a source that is uniform in space. So the
/// difference of the residual between two places vanishes.
TEST(MandelSolution, PressureDiffusesWithAUniformSource) {
  const MandelSolution mandel(table_1);
  const double c = mandel.consolidation_coefficient();
  const auto residual = [&](double x, double t) {
    const double dt = 1e-3 * t;
    const double dx = 0.02;
    const double rate = (mandel.pressure(x, t + dt) - mandel.pressure(x, t - dt)) / (2.0 * dt);
    const double curvature =
        (mandel.pressure(x + dx, t) - 2.0 * mandel.pressure(x, t) + mandel.pressure(x - dx, t)) /
        (dx * dx);
    return rate - c * curvature;
  };
  for (const double t : {2.0, 20.0, 100.0}) {
    const double scale = mandel.initial_pressure() / t;
    for (const double x : {3.0, 17.0, 31.0, 38.0}) {
      EXPECT_NEAR(residual(x, t), residual(10.0, t), 1e-4 * scale);
    }
  }
}

/// Vertical equilibrium of the slab: the plate carries F at any time, with the stress that plane
/// strain and a free side give, sigma_yy = 4 mu (lambda + mu) / (lambda + 2 mu) eps_yy
/// - 2 mu alpha p / (lambda + 2 mu).
TEST(MandelSolution, PlateCarriesTheForceAtAnyTime) {
  const MandelSolution mandel(table_1);
  const double lambda = table_1.lame_lambda, mu = table_1.shear_modulus;
  for (const double t : {0.5, 5.0, 50.0, 500.0}) {
    double pressure = 0.0;  // integral over the half width, midpoint rule
    constexpr int cells = 4000;
    const double dx = table_1.half_width / cells;
    for (int i = 0; i < cells; ++i) pressure += mandel.pressure((i + 0.5) * dx, t) * dx;
    const double strain = mandel.plate_displacement(t) / table_1.half_height;
    const double force =
        4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu) * strain * table_1.half_width -
        2.0 * mu * table_1.biot_coefficient / (lambda + 2.0 * mu) * pressure;
    EXPECT_NEAR(force, -table_1.force, 1e-6 * table_1.force);
  }
}

TEST(MandelSolution, StartsUndrainedAndEndsDrained) {
  const MandelSolution mandel(table_1);
  EXPECT_DOUBLE_EQ(mandel.pressure(10.0, 0.0), mandel.initial_pressure());
  EXPECT_NEAR(mandel.pressure(10.0, 1e-2), mandel.initial_pressure(),
              4e-3 * mandel.initial_pressure());
  EXPECT_NEAR(mandel.pressure(40.0, 1.0), 0.0, 1e-12);
  EXPECT_NEAR(mandel.plate_displacement(1e-6), mandel.plate_displacement(0.0), 1e-9);
  const double drained = -0.5 * (1.0 - 0.25) * 1e4 * 20.0 / (4e8 * 40.0);
  EXPECT_NEAR(mandel.plate_displacement(1e5), drained, 1e-12);
}

}  // namespace
}  // namespace perifrac
