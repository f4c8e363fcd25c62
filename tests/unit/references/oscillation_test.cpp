#include "app/references/solutions/oscillation.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

std::vector<double> times(double end) {
  std::vector<double> result;
  for (int n = 0; 0.01 * n <= end; ++n) result.push_back(0.01 * n);
  return result;
}

TEST(Oscillation, FindsPeriodAndMeanUnderAHigherMode) {
  const std::vector<double> t = times(10.0);
  std::vector<double> values;
  for (const double s : t) {
    values.push_back(3.0 + std::sin(2.0 * M_PI * s / 1.7) + 0.2 * std::sin(2.0 * M_PI * s / 0.17));
  }
  const auto found = oscillation(t, values, 3.0, 0.5);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->period, 1.7, 1e-3);
  EXPECT_NEAR(found->mean, 3.0, 2e-3);
}

TEST(Oscillation, NeedsAWholePeriod) {
  const std::vector<double> t = times(2.5);
  std::vector<double> values;
  for (const double s : t) values.push_back(1.0 - std::cos(2.0 * M_PI * s / 2.0));
  EXPECT_FALSE(oscillation(t, values, 1.0, 0.5)) << "one upward crossing only";
  EXPECT_FALSE(oscillation({}, {}, 1.0, 0.5));
}

}  // namespace
}  // namespace perifrac
