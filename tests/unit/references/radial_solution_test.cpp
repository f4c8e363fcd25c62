#include "app/references/solutions/radial_solution.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// E' = 1 GPa, mu' = 0.012 Pa s, 1 cm^3/s, and Gc for a dimensionless toughness at 1 s.
RadialProblem problem_of(double toughness) {
  RadialProblem problem{1e9, 1.0, 1e-3, 1e-6};
  problem.fracture_energy = std::pow(toughness / problem.dimensionless_toughness(1.0), 2);
  return problem;
}

/// Of the viscosity corner at 1 s: (Q^3 E' t^4/mu')^(1/9), (mu'/(E' t))^(1/3).
const double length = std::pow(1e-18 * 1e9 / 0.012, 1.0 / 9.0);
const double thin = std::cbrt(0.012 / 1e9);

/// tests/references/penny.py: table_row(K, 1e-3, start=1e-3), of table_row(K, 0.03, start=1e-3) the
/// pressure.
struct Row {
  double toughness, radius, opening, pressure;
};
constexpr Row rows[] = {
    {0.1, 0.69776, 1.19309, 0.93005}, {0.3, 0.69733, 1.19351, 0.93018},
    {0.6, 0.69401, 1.19698, 0.93127}, {1.0, 0.68135, 1.21305, 0.93688},
    {1.3, 0.66520, 1.23918, 0.94786}, {1.6, 0.64473, 1.28119, 0.96938},
    {2.0, 0.61421, 1.36353, 1.01885}, {2.5, 0.57637, 1.50206, 1.12730},
    {3.0, 0.54242, 1.66600, 1.27820}, {4.0, 0.48808, 2.02523, 1.66670},
    {6.0, 0.41681, 2.75533, 2.60939}, {8.0, 0.37182, 3.45671, 3.65715},
};

TEST(RadialSolution, AgreesWithTheMarchAtAnyToughness) {
  for (const Row& row : rows) {
    SCOPED_TRACE(testing::Message() << "K " << row.toughness);
    const RadialSolution solution(problem_of(row.toughness));
    EXPECT_NEAR(solution.radius(1.0) / (row.radius * length), 1.0, 0.0075);
    EXPECT_NEAR(solution.opening(0.0, 1.0) / (row.opening * thin * length), 1.0, 0.005);
    EXPECT_NEAR(solution.source_pressure(0.03 * length, 1.0) / (row.pressure * 1e9 * thin), 1.0,
                0.015);
  }
}

/// The same in a rock's units: `penny.py --rows 4` without further options.
TEST(RadialSolution, AgreesWithTheMarchInARock) {
  const RadialProblem rock{20e9 / 0.9375, 20.0, 4e-3, 2e-8};
  const RadialSolution solution(rock);
  EXPECT_NEAR(rock.dimensionless_toughness(0.1), 2.4977, 1e-4);
  EXPECT_NEAR(solution.radius(0.1), 0.0110732, 0.006 * 0.0110732);
  EXPECT_NEAR(solution.opening(0.0, 0.1), 8.10904e-6, 0.005 * 8.10904e-6);
  EXPECT_NEAR(solution.source_pressure(0.92e-3, 0.1), 6.65007e6, 0.014 * 6.65007e6);
  EXPECT_NEAR(solution.radius(0.025), 0.00625799, 0.007 * 0.00625799);
  EXPECT_NEAR(solution.source_pressure(0.92e-3, 0.025), 9.37458e6, 0.016 * 9.37458e6);
}

/// Savitski and Detournay 2002.
TEST(RadialSolution, TendsToItsCorners) {
  const RadialSolution thin_rock(problem_of(0.01));
  EXPECT_NEAR(thin_rock.radius(1.0) / length, 0.6944, 2e-4);
  EXPECT_NEAR(thin_rock.opening(0.0, 1.0) / (thin * length), 1.1901, 3e-4);
  EXPECT_NEAR(thin_rock.radius(2.0) / thin_rock.radius(1.0), std::pow(2.0, 4.0 / 9.0), 1e-5);

  const RadialProblem tough = problem_of(20.0);
  const RadialSolution solution(tough);
  const double k = tough.toughness();
  const double radius = 0.8546 * std::pow(1e9 * 1e-6 / k, 0.4);
  EXPECT_NEAR(solution.radius(1.0) / radius, 1.0, 2e-4);
  EXPECT_NEAR(solution.opening(0.0, 1.0) / (0.6537 * std::pow(std::pow(k, 4) * 1e-42, 0.2)), 1.0,
              2e-4);
  // Even pressure: K_IC = 2 p (R/pi)^(1/2).
  const double even = k / (4.0 * std::sqrt(2.0 / M_PI)) / 2.0 * std::sqrt(M_PI / radius);
  EXPECT_NEAR(solution.source_pressure(0.1 * radius, 1.0) / even, 1.0, 5e-4);
}

TEST(RadialSolution, HoldsWhatIsPumpedIn) {
  for (const double toughness : {0.1, 1.0, 3.0}) {
    for (const double t : {0.01, 1.0}) {
      const RadialSolution solution(problem_of(toughness));
      const double radius = solution.radius(t);
      double volume = 0.0;
      constexpr int count = 200;
      for (int n = 0; n < count; ++n) {  // Simpson over equal steps of (1 - r/R)^(1/3)
        for (const auto& [at, weight] : {std::pair{0.0, 1.0}, {0.5, 4.0}, {1.0, 1.0}}) {
          const double s = (n + at) / count;
          const double r = radius * (1.0 - s * s * s);
          volume += 2.0 * M_PI * r * solution.opening(r, t) * radius * 3.0 * s * s * weight /
                    (6.0 * count);
        }
      }
      EXPECT_NEAR(volume / (1e-6 * t), 1.0, 1e-5) << toughness << ' ' << t;
      EXPECT_EQ(solution.opening(1.001 * radius, t), 0.0);
    }
  }
}

TEST(RadialSolution, GrowsShorterAndWiderWithToughness) {
  double radius = 1.0, opening = 0.0, pressure = 0.0;
  for (double toughness = 0.1; toughness < 10.0; toughness *= 1.1) {
    const RadialSolution solution(problem_of(toughness));
    EXPECT_LT(solution.radius(1.0), radius) << toughness;
    EXPECT_GT(solution.radius(1.1), solution.radius(1.0)) << toughness;
    EXPECT_GT(solution.opening(0.0, 1.0), opening) << toughness;
    radius = solution.radius(1.0);
    opening = solution.opening(0.0, 1.0);
    // Below, it is even to 1e-4.
    if (toughness < 0.7) continue;
    EXPECT_GT(solution.source_pressure(0.03 * length, 1.0), pressure) << toughness;
    pressure = solution.source_pressure(0.03 * length, 1.0);
  }
}

/// As radial flow between them has it.
TEST(RadialSolution, TheSourceCostsPressureByTheLogarithmOfItsRadius) {
  const RadialSolution solution(problem_of(4.0));
  const double friction = 0.012 * 1e-6 / (2.0 * M_PI * std::pow(solution.opening(0.0, 1.0), 3));
  for (const double source : {0.005, 0.01, 0.02}) {
    const double fall = solution.source_pressure(source * length, 1.0) -
                        solution.source_pressure(2.0 * source * length, 1.0);
    EXPECT_NEAR(fall / (friction * std::log(2.0)), 1.0, 0.01) << source;
  }
}

}  // namespace
}  // namespace perifrac
