#include "app/references/solutions/seepage_solution.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "app/references/solutions/slab_inflow.hpp"

namespace perifrac {
namespace {

/// The paper's constant head test.
SeepageProblem specimen() {
  return {.length = 50.0,
          .mobility = 1.02e-8,
          .storage = 0.306 / 22e6,
          .pressure = 98.1e3,
          .schedule = {}};
}

TEST(SeepageSolution, IsTheDiffusionOfAStep) {
  const SeepageProblem problem = specimen();
  const SeepageSolution solution(problem);
  EXPECT_NEAR(solution.time_scale() / (M_PI * M_PI), 345.0, 1.0);
  EXPECT_NEAR(solution.steady_flux(), 2.0e-5, 2e-8);
  const double diffusivity = problem.mobility / problem.storage;
  EXPECT_NEAR(solution.pressure(47.0, 10.0),
              98.1e3 * std::erfc(3.0 / std::sqrt(40.0 * diffusivity)), 1e-6);
  EXPECT_NEAR(solution.volume(10.0),
              98.1e3 * std::sqrt(4.0 / M_PI * 10.0 * problem.mobility * problem.storage), 1e-12);
  EXPECT_NEAR(solution.pressure(20.0, 1e5), 0.4 * 98.1e3, 1e-6);
  EXPECT_NEAR(solution.volume(1e5 + 1.0) - solution.volume(1e5), solution.steady_flux(), 1e-15);
}

/// Duhamel's integral of the rate of change of the water's pressure, by the midpoint rule.
double superposed(const SeepageProblem& problem, double t, auto answer) {
  constexpr int parts = 40000;
  const auto pressure = [&](double s) { return problem.pressure * problem.schedule.factor(s); };
  double sum = (pressure(0.0) - problem.initial_pressure) * answer(t);
  for (int n = 0; n < parts; ++n) {
    const double from = t * n / parts, to = t * (n + 1) / parts;
    sum += (pressure(to) - pressure(from)) * answer(t - 0.5 * (from + to));
  }
  return sum;
}

TEST(SeepageSolution, OfATableIsDuhamelsIntegral) {
  SeepageProblem problem = specimen();
  problem.schedule = Schedule::table({-5.0, 40.0, 100.0, 300.0}, {0.2, 1.0, 0.3, 0.5});
  problem.initial_pressure = 30e3;
  const SeepageSolution solution(problem);
  const double scale = solution.time_scale();
  for (const double t : {10.0, 70.0, 250.0, 1000.0}) {
    for (const double z : {10.0, 40.0}) {
      const double exact =
          problem.initial_pressure * z / problem.length + superposed(problem, t, [&](double s) {
            return slab_inflow::value(z / problem.length, s / scale);
          });
      EXPECT_NEAR(solution.pressure(z, t), exact, 1e-2) << t << ' ' << z;
    }
    const double entered =
        problem.initial_pressure * problem.mobility / problem.length * t +
        superposed(problem, t, [&](double s) {
          return problem.storage * problem.length * slab_inflow::inflow(s / scale);
        });
    EXPECT_NEAR(solution.volume(t), entered, 1e-5 * entered) << t;
  }
}

TEST(SeepageSolution, WhatEntersIsStoredOrLeaves) {
  SeepageProblem problem = specimen();
  problem.schedule = Schedule::ramp(40.0);
  const SeepageSolution solution(problem);
  constexpr int parts = 2000;
  const double dz = problem.length / parts;
  const auto stored = [&](double t) {
    double sum = 0.0;
    for (int n = 0; n < parts; ++n) sum += solution.pressure((n + 0.5) * dz, t) * dz;
    return problem.storage * sum;
  };
  const auto leaving = [&](double t) {  // at z = 0
    return problem.mobility * solution.pressure(1e-3, t) / 1e-3;
  };
  double left = 0.0;
  for (int n = 0; n < 3000; ++n) left += leaving(n + 0.5);
  EXPECT_NEAR(solution.volume(3000.0), stored(3000.0) + left, 1e-6 * left);
}

TEST(SeepageSolution, StaysWhereItStartsSteady) {
  SeepageProblem problem = specimen();
  problem.initial_pressure = problem.pressure;
  const SeepageSolution solution(problem);
  for (const double t : {1.0, 1000.0}) {
    EXPECT_NEAR(solution.pressure(15.0, t), 0.3 * problem.pressure, 1e-9);
    EXPECT_NEAR(solution.volume(t), solution.steady_flux() * t, 1e-15);
  }
}

}  // namespace
}  // namespace perifrac
