#include "app/warnings/pressure_swing.hpp"

#include <cmath>
#include <functional>
#include <span>

#include <gtest/gtest.h>

#include "core/geometry/lattice.hpp"

namespace perifrac {
namespace {

double found(double (*find)(const Body<2>&, std::span<const double>),
             const std::function<double(const Vector<2>&)>& pressure) {
  const Body<2> body(box_lattice<2>({12, 8}, 1.0, {0, 0}), {}, 1.0, 2.5,
                     InfluenceFunction::constant);
  const auto family = body.family(0);
  std::vector<double> values;
  for (Index i = 0; i < body.points().size(); ++i) values.push_back(pressure(body.points().at(i)));
  return find(body, values);
}

double swing_of(const std::function<double(const Vector<2>&)>& pressure) {
  return found(largest_swing<2>, pressure);
}

/// Of an even fall one part in as many as there are spacings; of a front as it falls there.
TEST(PressureStep, IsTheLargestFromPointToPoint) {
  EXPECT_NEAR(found(largest_step<2>, [](const Vector<2>& x) { return 7.0 - 3.0 * x[0]; }), 1.0 / 11,
              1e-12);
  EXPECT_EQ(found(largest_step<2>, [](const Vector<2>& x) { return x[1] < 3.0 ? 0.0 : 2.0; }), 1.0);
  const auto front = [](double x) { return std::erfc(0.2 * x); };
  EXPECT_NEAR(found(largest_step<2>, [&](const Vector<2>& x) { return front(x[0]); }),
              (front(0.5) - front(1.5)) / (front(0.5) - front(11.5)), 1e-12);
}

TEST(PressureSwing, OfSmoothPressuresIsNone) {
  EXPECT_EQ(swing_of([](const Vector<2>&) { return 5.0; }), 0.0);
  EXPECT_EQ(swing_of([](const Vector<2>& x) { return 3.0 * x[0] - x[1]; }), 0.0);
  EXPECT_EQ(
      swing_of([](const Vector<2>& x) { return std::sin(0.6 * x[0]) * std::cos(0.5 * x[1]); }),
      0.0);
}

TEST(PressureSwing, OfAJumpOrOneHighPointIsNone) {
  EXPECT_EQ(swing_of([](const Vector<2>& x) { return x[0] < 6.0 ? 0.0 : 1.0; }), 0.0);
  EXPECT_EQ(swing_of([](const Vector<2>& x) { return std::exp(-4.0 * std::abs(x[0] - 6.5)); }),
            0.0);
}

TEST(PressureSwing, IsTheStepThatGoesAgainstTheOthers) {
  // As beside a face that drains suddenly: 0.4, 1.2, 0.95, 1, 1, ...
  const auto overshoot = [](const Vector<2>& x) {
    return x[0] < 1.0 ? 0.4 : x[0] < 2.0 ? 1.2 : x[0] < 3.0 ? 0.95 : 1.0;
  };
  EXPECT_NEAR(swing_of(overshoot), 0.25 / 0.8, 1e-12);
}

TEST(PressureSwing, OfRoundingIsNone) {
  EXPECT_LT(swing_of([](const Vector<2>& x) { return 30e6 + 1e-6 * std::sin(1e3 * x[0]); }), 1e-9);
}

}  // namespace
}  // namespace perifrac
