#include "app/study/orders.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::DoubleNear;
using testing::ElementsAre;
using testing::IsEmpty;

TEST(power, of_a_power_is_its_exponent) {
  const std::vector<double> x = {0.25, 1.0, 3.0};
  std::vector<double> y;
  for (const double value : x) y.push_back(7.0 * std::pow(value, -2.5));
  EXPECT_NEAR(*power(x, y), -2.5, 1e-12);
}

TEST(power, leaves_out_what_has_no_logarithm) {
  EXPECT_NEAR(*power(std::vector{1.0, 2.0, 4.0, 8.0}, std::vector<double>{1.0, 0.0, 16.0, NAN}),
              2.0, 1e-12);
  EXPECT_FALSE(power(std::vector{1.0, 2.0}, std::vector{1.0, 0.0}));
  EXPECT_FALSE(power(std::vector{2.0, 2.0}, std::vector{1.0, 3.0}));
}

TEST(crossings, lie_where_the_logarithms_meet) {
  // 3 x^0 and 0.03 x meet at x = 100.
  const std::vector<double> x = {1.0, 10.0, 1000.0, 10000.0}, flat(4, 3.0);
  const std::vector<double> rising = {0.03, 0.3, 30.0, 300.0};
  EXPECT_THAT(crossings(x, rising, flat), ElementsAre(DoubleNear(100.0, 1e-9)));
  EXPECT_THAT(crossings(x, flat, rising), ElementsAre(DoubleNear(100.0, 1e-9)));
  EXPECT_THAT(crossings(x, flat, std::vector<double>(4, 4.0)), IsEmpty());
}

TEST(crossings, that_only_touch_are_none) {
  const std::vector<double> x = {1.0, 2.0, 4.0}, a = {2.0, 1.0, 2.0}, b(3, 1.0);
  EXPECT_THAT(crossings(x, a, b), IsEmpty());
}

TEST(crossings, of_curves_too_near_to_tell_are_none) {
  const std::vector<double> x = {1.0, 2.0, 4.0, 8.0}, a = {1.05, 0.95, 1.02, 3.0}, b(4, 1.0);
  EXPECT_THAT(crossings(x, a, b), testing::SizeIs(2));
  EXPECT_THAT(crossings(x, a, b, 1.1), IsEmpty());
}

TEST(extrapolate, finds_order_and_limit_of_a_power) {
  const auto f = [](double h) { return 5.0 + 0.3 * h * h * h; };
  const auto found = extrapolate(f(4.0) - f(2.0), f(2.0) - f(1.0), 2.0);
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->order, 3.0, 1e-12);
  EXPECT_NEAR(f(1.0) + found->share * (f(1.0) - f(2.0)), 5.0, 1e-12);
}

TEST(extrapolate, needs_distances_that_fall) {
  EXPECT_FALSE(extrapolate(1.0, 1.0, 2.0));
  EXPECT_FALSE(extrapolate(1.0, 0.0, 2.0));
  EXPECT_FALSE(extrapolate(1.0, 0.5, 1.0));
}

}  // namespace
}  // namespace perifrac
