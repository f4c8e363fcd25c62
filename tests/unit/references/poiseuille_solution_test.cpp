#include "app/references/solutions/poiseuille_solution.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

constexpr PoiseuilleProblem problem{.gap = 0.01, .viscosity = 5e-5, .acceleration = 0.2};

TEST(PoiseuilleSolution, ObeysTheMomentumEquation) {
  const PoiseuilleSolution solution(problem);
  for (const double T : {1e-3, 0.01, 0.1, 1.0}) {
    const double t = T * solution.time_scale();
    const double dt = 1e-3 * t;
    const double h = 1e-3 * problem.gap;
    for (const double y : {0.001, 0.004, 0.0095}) {
      const auto u = [&](double at, double when) { return solution.velocity(at, when); };
      const double rate = (u(y, t + dt) - u(y, t - dt)) / (2.0 * dt);
      const double curvature = (u(y + h, t) - 2.0 * u(y, t) + u(y - h, t)) / (h * h);
      EXPECT_NEAR(rate, problem.acceleration + problem.viscosity * curvature,
                  2e-4 * problem.acceleration)
          << T << ' ' << y;
    }
    EXPECT_NEAR(solution.velocity(0.0, t), 0.0, 1e-12 * solution.peak());
    EXPECT_NEAR(solution.velocity(problem.gap, t), 0.0, 1e-12 * solution.peak());
  }
}

TEST(PoiseuilleSolution, StartsFromRestAndEndsInTheParabola) {
  const PoiseuilleSolution solution(problem);
  EXPECT_DOUBLE_EQ(solution.peak(), 0.05);
  EXPECT_EQ(solution.velocity(0.005, 0.0), 0.0);
  // Away from the plates it falls freely at first.
  EXPECT_NEAR(solution.velocity(0.005, 1e-3), 2e-4, 1e-9);
  EXPECT_NEAR(solution.velocity(0.005, 100.0), 0.05, 1e-15);
  EXPECT_NEAR(solution.velocity(0.0025, 100.0), 0.75 * 0.05, 1e-15);
}

}  // namespace
}  // namespace perifrac
