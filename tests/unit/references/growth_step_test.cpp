#include "app/references/growth_step.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// Rows at 0, 0.5, ... 10; exact is 2 t.
std::optional<double> worst(double (*over_exact)(double t), double step,
                            BetweenRows between = BetweenRows::linear) {
  std::vector<double> times, values;
  for (int k = 0; k <= 20; ++k) {
    times.push_back(0.5 * k);
    values.push_back(over_exact(times.back()) * 2.0 * times.back());
  }
  return worst_mean_of_growth([=](double) { return step; }, 10.0, [](double t) { return 2.0 * t; },
                              between)(times, values);
}

TEST(GrowthStep, TheWorstMeanIsTheOneFarthestFromOne) {
  const auto low_late = [](double t) { return t > 7.9 ? 0.7 : 1.1; };
  EXPECT_DOUBLE_EQ(worst(low_late, 1.5).value(), 0.7);
  // Up within half a second, high for one, down again.
  const auto high_for_one = [](double t) { return t > 6.4 && t < 7.6 ? 1.4 : 1.0; };
  EXPECT_NEAR(worst(high_for_one, 4.0).value(), 1.0 + 0.4 * 1.5 / 4.0, 1e-12);
}

/// A crack that is longer by one at every second and else stays, beside 2 t - 1, which it is in the
/// mean of a second; evenly from row to row it would be longer by a quarter of what it grows by.
TEST(GrowthStep, ALengthStaysUntilTheRowInWhichItGrows) {
  std::vector<double> times, length;
  for (int k = 0; k <= 80; ++k) {
    times.push_back(0.25 * k);
    length.push_back(2.0 * std::floor(times.back() + 1e-9));
  }
  const auto error = [&](BetweenRows between) {
    const auto worst = worst_mean_of_growth([](double) { return 1.0; }, 20.0,
                                            [](double t) { return 2.0 * t - 1.0; }, between);
    return (worst(times, length).value() - 1.0) * (2.0 * 10.5 - 1.0);  // at t = 10.5, the first
  };
  EXPECT_NEAR(error(BetweenRows::held), 0.0, 0.02);
  EXPECT_NEAR(error(BetweenRows::linear), 0.25, 0.02);
}

TEST(GrowthStep, WhatIsBeforeTheLatterHalfDoesNotCount) {
  const auto wild_early = [](double t) { return t < 4.9 ? 5.0 : 1.0; };
  EXPECT_DOUBLE_EQ(worst(wild_early, 1.0).value(), 1.0);
}

TEST(GrowthStep, ThereIsNoneWhereNoStepFits) {
  const auto any = [](double) { return 1.0; };
  EXPECT_FALSE(worst(any, 6.0).has_value());
}

}  // namespace
}  // namespace perifrac
