#include "app/warnings/regime.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// E' of 700 MPa at nu = 0.25, K_m = 1.16.
const KgdProblem water{700e6 / 0.9375, 5.0, 1e-3, 1.6e-4};
constexpr double t = 0.1;

/// Unit scales: E' = 1 GPa, mu' = 0.012 Pa s, Q = 1e-4 m^2/s at 1 s.
HydraulicFracture fracture_of(double toughness, double leak_off_number) {
  const KgdProblem tough{1e9, 1.0, 1e-3, 1e-4};
  HydraulicFracture fracture{.driven = tough};
  fracture.driven.fracture_energy = std::pow(toughness / tough.dimensionless_toughness(), 2);
  fracture.leak_off_coefficient = 1.0;
  fracture.leak_off_coefficient = leak_off_number / perifrac::leak_off_number(fracture, 1.0);
  return fracture;
}

void expect_near(const CrackSize& crack, const CrackSize& expected, double tolerance) {
  EXPECT_NEAR(crack.length, expected.length, tolerance * expected.length);
  EXPECT_NEAR(crack.opening, expected.opening, tolerance * expected.opening);
  EXPECT_NEAR(crack.pressure, expected.pressure, tolerance * expected.pressure);
}

/// Figures worked out by hand from the formulas.
TEST(Regime, HasTheNumbersOfTheLiterature) {
  EXPECT_NEAR(water.toughness(), 195.006e3, 1.0);
  EXPECT_NEAR(water.dimensionless_toughness(), 1.15979, 1e-5);
  expect_near(viscosity_corner(water, t), {0.105536, 1.05067e-4, 221449.0}, 1e-5);
  expect_near(toughness_corner(water, t), {0.1448980, 7.029717e-5, 90561.23}, 1e-5);
  const HydraulicFracture leaky{water, 1e-4, 3e6};
  EXPECT_NEAR(leak_off_number(leaky, t), 0.678101, 1e-6);
  EXPECT_NEAR(leak_off_corner(leaky, t), 0.0805267, 1e-7);
  EXPECT_NEAR(leak_off_over_toughness(leaky, 1.0, t), 0.0537345, 1e-7);
  EXPECT_NEAR(leak_off_over_toughness(leaky, 0.5, t), 0.214938, 1e-7);
  EXPECT_NEAR(lag_time(leaky), 2.47783e-4, 1e-9);
  EXPECT_TRUE(std::isinf(lag_time({water, 0.0, 0.0})));
}

/// Spence and Sharp's solution at K_m = 1.16, from tests/references/kgd.py.
TEST(Regime, LiesBetweenItsCorners) {
  expect_near(storage_solution(water, t), {0.1014, 1.0734e-4, 228500.0}, 1e-3);
  const KgdProblem thin = fracture_of(0.14999, 0.0).driven, tough = fracture_of(6.001, 0.0).driven;
  expect_near(storage_solution(fracture_of(0.15, 0.0).driven, t), viscosity_corner(thin, t), 2e-3);
  expect_near(storage_solution(fracture_of(6.0, 0.0).driven, t), toughness_corner(tough, t), 8e-3);
}

TEST(Regime, KeepsAllWhereNothingLeaks) {
  EXPECT_NEAR(efficiency({water, 0.0, 0.0}, t), 1.0, 1e-12);
  expect_near(expected_crack({water, 0.0, 0.0}, t), storage_solution(water, t), 1e-12);
}

/// Marched in time by tests/references/kgd.py with Carter's leak-off.
TEST(Regime, LeaksAsTheMarchedSolution) {
  struct Row {
    double toughness, leak_off, efficiency, length, opening, pressure;
  };
  constexpr Row rows[] = {
      {0.3, 0.3, 0.6067, 0.4361, 0.9569, 0.6468}, {0.3, 1, 0.2534, 0.2430, 0.7150, 0.8636},
      {0.3, 10, 0.0118, 0.0315, 0.2568, 2.3898},  {1.16, 0.3, 0.6149, 0.4272, 0.9771, 0.6596},
      {1.16, 1, 0.2598, 0.2410, 0.7309, 0.8738},  {1.16, 10, 0.0122, 0.0315, 0.2629, 2.4069},
      {5, 0.3, 0.7627, 0.2650, 1.8351, 1.7384},   {5, 1, 0.4415, 0.1841, 1.5288, 2.0846},
      {5, 10, 0.0304, 0.0310, 0.6265, 5.0799}};
  const double thin = std::cbrt(0.012 / 1e9);
  const double length = std::pow(1e9 * 1e-12 / 0.012, 1.0 / 6.0);
  for (const Row& row : rows) {
    SCOPED_TRACE(testing::Message() << "K_m " << row.toughness << ", C_m " << row.leak_off);
    const HydraulicFracture fracture = fracture_of(row.toughness, row.leak_off);
    EXPECT_NEAR(efficiency(fracture, 1.0), row.efficiency, 0.006);
    const CrackSize crack = expected_crack(fracture, 1.0);
    EXPECT_NEAR(crack.length / (row.length * length), 1.0, 0.01);
    EXPECT_NEAR(crack.opening / (row.opening * thin * length), 1.0, 0.0115);
    EXPECT_NEAR(crack.pressure / (row.pressure * 1e9 * thin), 1.0, 0.015);
  }
}

TEST(Regime, TendsToTheLeakOffCorner) {
  double gap = 2.0;
  for (const double number : {1.0, 10.0, 100.0, 1000.0}) {
    const HydraulicFracture fracture = fracture_of(1.0, number);
    const double now = 1.0 - expected_crack(fracture, 1.0).length / leak_off_corner(fracture, 1.0);
    EXPECT_GT(now, 0.0);
    EXPECT_LT(now, 0.2 * gap);
    gap = now;
  }
  EXPECT_LT(gap, 1e-4);
}

/// hf_storage without its stress, to which tests/references/kgd.py gives 0.0766 of the length.
TEST(Regime, BoundsTheDryTip) {
  const double length = storage_solution(water, t).length;
  EXPECT_NEAR(largest_lag({water, 0.0, 0.0}, t), 0.0766 * length, 1e-3 * length);
  // A short one: .3574 mu' V E'^2 / stress^3.
  const HydraulicFracture confined{water, 0.0, 3e6};
  EXPECT_NEAR(largest_lag(confined, t), 0.3574 * 2.47783e-4 * length / (1.5 * t), 1e-5 * length);
  // Toughness leaves less room, down to none.
  EXPECT_LT(largest_lag(fracture_of(3.0, 0.0), t), 1e-4 * length);
  EXPECT_LE(largest_lag(fracture_of(0.01, 0.0), t),
            storage_solution(fracture_of(0.01, 0.0).driven, t).length);
}

TEST(Regime, NamesItsCorner) {
  EXPECT_EQ(corner(0.3, 1.0), "viscosity; storage");
  EXPECT_EQ(corner(5.0, 0.01), "toughness; leak-off");
  EXPECT_EQ(corner(1.16, 0.5), "viscosity and toughness; storage and leak-off");
  EXPECT_EQ(corner(1.16, 0.8), "viscosity and toughness; mostly storage");
  EXPECT_EQ(corner(0.3, 0.2), "viscosity; mostly leak-off");
}

}  // namespace
}  // namespace perifrac
