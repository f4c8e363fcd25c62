#include "app/references/growth_step.hpp"

#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// Rows at 0, 0.5, ... 10; exact is 2 t.
std::optional<double> worst(double (*over_exact)(double t), double step) {
  std::vector<double> times, values;
  for (int k = 0; k <= 20; ++k) {
    times.push_back(0.5 * k);
    values.push_back(over_exact(times.back()) * 2.0 * times.back());
  }
  return worst_mean_of_growth([=](double) { return step; }, 10.0, [](double t) { return 2.0 * t; })(
      times, values);
}

TEST(GrowthStep, TheWorstMeanIsTheOneFarthestFromOne) {
  const auto low_late = [](double t) { return t > 7.9 ? 0.7 : 1.1; };
  EXPECT_DOUBLE_EQ(worst(low_late, 1.5).value(), 0.7);
  // Up within half a second, high for one, down again.
  const auto high_for_one = [](double t) { return t > 6.4 && t < 7.6 ? 1.4 : 1.0; };
  EXPECT_NEAR(worst(high_for_one, 4.0).value(), 1.0 + 0.4 * 1.5 / 4.0, 1e-12);
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
