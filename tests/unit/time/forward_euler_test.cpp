#include "core/time/forward_euler.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "tests/unit/time/line_diffusion.hpp"

namespace perifrac {
namespace {

using test::largest_difference;
using test::LineDiffusion;

double largest_content(const std::vector<double>& y) {
  return std::abs(*std::max_element(y.begin(), y.end() - 1,
                                    [](double a, double b) { return std::abs(a) < std::abs(b); }));
}

TEST(ForwardEuler, FindsTheStableLimitFromBelow) {
  for (const std::size_t cells : {3, 30, 100}) {
    LineDiffusion line(cells);
    ForwardEuler euler(line);
    euler.reset(0.0, line.start());
    EXPECT_LE(euler.stable_step(), line.stable_step()) << cells;
    EXPECT_GE(euler.stable_step(), 0.9 * line.stable_step()) << cells;
  }
}

TEST(ForwardEuler, IgnoresAccumulatorsOfAnyUnitInTheLimit) {
  LineDiffusion line(30);
  ForwardEuler euler(line);
  euler.reset(0.0, line.start());
  const double limit = euler.stable_step();

  struct InOtherUnits final : LineDiffusion {
    using LineDiffusion::LineDiffusion;
    void jacobian_times(double t, std::span<const double> y, std::span<const double> v,
                        std::span<double> product) override {
      LineDiffusion::jacobian_times(t, y, v, product);
      product.back() *= 1e9;
    }
  } scaled(30);
  ForwardEuler other(scaled);
  other.reset(0.0, scaled.start());
  EXPECT_EQ(other.stable_step(), limit);
}

/// J grows in time by a factor that it tells: steps shorten with it and stay stable.
TEST(ForwardEuler, ShortensItsStepsAsTheSystemStiffens) {
  struct Stiffening final : LineDiffusion {
    using LineDiffusion::LineDiffusion;
    double jacobian_growth(double t, std::span<const double>) override { return 1.0 + t; }
    void rhs(double t, std::span<const double> y, std::span<double> dydt) override {
      jacobian_times(t, y, y, dydt);
      for (double& rate : dydt) rate *= 1.0 + t;
    }
  } line(30);
  ForwardEuler euler(line, 0.9);
  std::vector<double> y = line.start();
  euler.reset(0.0, y);
  const double end = 200.0 * euler.stable_step();
  const double before = line.invariant(y);
  euler.advance(end, y);
  EXPECT_LT(largest_content(y), 1.5);
  EXPECT_NEAR(line.invariant(y), before, 1e-12 * std::abs(before));
  const double least = (end + 0.5 * end * end) / (0.9 * euler.stable_step());
  EXPECT_GE(euler.statistics().steps, least * 0.98);
  EXPECT_LE(euler.statistics().steps, least * 1.02 + 2.0);
}

TEST(ForwardEuler, DecaysBelowTheLimitAndGrowsAboveIt) {
  LineDiffusion line(30);
  const double limit = line.stable_step();
  for (const double ratio : {0.99, 1.05}) {
    ForwardEuler euler(line, 2.0 * ratio);
    std::vector<double> y = line.start();
    euler.reset(0.0, y);
    // One window a step of ratio * limit, well below safety * limit so that none is divided.
    for (int n = 1; n <= 2000; ++n) euler.advance(n * ratio * limit, y);
    EXPECT_EQ(euler.statistics().steps, 2000);
    if (ratio < 1.0)
      EXPECT_LT(largest_content(y), 1.5);
    else
      EXPECT_GT(largest_content(y), 1e6);
  }
}

TEST(ForwardEuler, IsOfFirstOrder) {
  LineDiffusion line(20);
  line.uptake = 0.3;
  const std::vector<double> start = line.start(), exact = line.exact(start, 2.0);
  std::vector<double> errors;
  for (const double safety : {0.4, 0.2, 0.1}) {
    ForwardEuler euler(line, safety);
    std::vector<double> y = start;
    euler.reset(0.0, y);
    euler.advance(2.0, y);
    errors.push_back(largest_difference(y, exact) * static_cast<double>(euler.statistics().steps));
  }
  // error x steps tends to a constant
  EXPECT_NEAR(errors[1] / errors[2], 1.0, 0.05);
  EXPECT_NEAR(errors[0] / errors[2], 1.0, 0.15);
}

TEST(ForwardEuler, DividesTheWindowIntoTheFewestEqualStepsBelowSafetyTimesTheLimit) {
  LineDiffusion line(20);
  ForwardEuler euler(line, 0.8);
  std::vector<double> y = line.start();
  euler.reset(1.0, y);
  const double longest = 0.8 * euler.stable_step();
  euler.advance(1.0 + 6.5 * longest, y);
  EXPECT_EQ(euler.statistics().steps, 7);
  EXPECT_EQ(euler.statistics().rhs_evaluations, 7);
  euler.advance(1.0 + 7.0 * longest, y);
  EXPECT_EQ(euler.statistics().steps, 8);
}

/// How far the pressures of an even line leave their first range, 1, when it begins to drain a
/// quarter of a cell from its first point.
double swing(bool noted) {
  LineDiffusion line(30);
  for (auto* values : {&line.volume, &line.storage, &line.link}) values->assign(30, 1.0);
  line.link[0] = 4.0;
  ForwardEuler euler(line);
  std::vector<double> y(line.size(), 0.0);
  std::ranges::copy(line.storage, y.begin());
  euler.reset(0.0, y);
  if (noted) euler.note_jump(0.0);
  const double longest = euler.longest_step();
  double furthest = 0.0;
  for (int n = 1; n <= 60; ++n) {
    euler.advance(n * longest, y);
    for (std::size_t i = 0; i < line.storage.size(); ++i) {
      const double pressure = y[i] / line.storage[i];
      furthest = std::max({furthest, pressure - 1.0, -pressure});
    }
  }
  return furthest;
}

TEST(ForwardEuler, DoesNotSwingAfterAJump) {
  EXPECT_LT(swing(true), 1e-3);
  EXPECT_GT(swing(false), 0.02);
}

TEST(ForwardEuler, TakesAFewMoreStepsAfterAJumpAndThenNoMore) {
  LineDiffusion line(20);
  ForwardEuler euler(line);
  std::vector<double> y = line.start();
  euler.reset(0.0, y);
  const double longest = euler.longest_step();
  euler.advance(20.0 * longest, y);
  EXPECT_EQ(euler.statistics().steps, 20);
  euler.note_jump(20.0 * longest);
  euler.advance(40.0 * longest, y);
  const auto after = euler.statistics().steps;
  EXPECT_GE(after, 44);
  EXPECT_LE(after, 46);
  euler.advance(60.0 * longest, y);
  EXPECT_EQ(euler.statistics().steps, after + 20);
}

TEST(ForwardEuler, KeepsTheInvariant) {
  LineDiffusion line(50);
  line.uptake = 0.7;
  ForwardEuler euler(line);
  std::vector<double> y = line.start();
  const double before = line.invariant(y);
  euler.reset(0.0, y);
  euler.advance(100.0, y);
  EXPECT_NEAR(line.invariant(y) / before, 1.0, 1e-13);
  EXPECT_GT(std::abs(y.back()), 0.1);
}

TEST(ForwardEuler, FindsTheLimitOncePerJacobian) {
  LineDiffusion line(20);
  ForwardEuler euler(line);
  euler.reset(0.0, line.start());
  const int products = line.products;
  const double limit = euler.stable_step();
  euler.reset(1.0, line.start());
  EXPECT_EQ(line.products, products);

  for (double& link : line.link) link *= 2.0;
  ++line.version;
  euler.reset(2.0, line.start());
  EXPECT_DOUBLE_EQ(euler.stable_step(), 0.5 * limit);
}

TEST(ForwardEuler, HasNoLimitWhereNothingFlows) {
  LineDiffusion line(5, 0.0);
  ForwardEuler euler(line);
  std::vector<double> y = line.start();
  const std::vector<double> before = y;
  euler.reset(0.0, y);
  EXPECT_EQ(euler.stable_step(), std::numeric_limits<double>::infinity());
  euler.advance(1e6, y);
  EXPECT_EQ(y, before);
  EXPECT_EQ(euler.statistics().steps, 1);
}

TEST(ForwardEuler, NamesFieldEntryAndTimeOfANumberThatIsNotFinite) {
  LineDiffusion line(5);
  line.poisoned_from = 0.5;
  ForwardEuler euler(line);
  std::vector<double> y = line.start();
  euler.reset(0.0, y);
  try {
    euler.advance(10.0, y);
    FAIL() << "no exception";
  } catch (const NumericalError& error) {
    EXPECT_EQ(error.field(), "line/content");
    EXPECT_EQ(error.time(), 10.0);
    EXPECT_THAT(error.what(), testing::HasSubstr("not finite"));
  }
}

/// The fastest mode, which a step of 1.8 / rate takes from 1 to -0.8, comes back with its own sign
/// where others answer it late; steps that turn no sign are as many as they were.
TEST(ForwardEuler, TakesAnEvenNumberOfLongStepsWhereItIsAnsweredLate) {
  struct Answered final : LineDiffusion {
    using LineDiffusion::LineDiffusion;
    bool is_answered_late() const override { return late; }
    bool late = true;
  } line(30);
  for (const bool late : {true, false}) {
    line.late = late;
    ForwardEuler euler(line);
    std::vector<double> y = line.start();
    euler.reset(0.0, y);
    const auto steps_in = [&](double begin, double end) {
      const auto before = euler.statistics().steps;
      euler.reset(begin, y);
      euler.advance(end, y);
      return euler.statistics().steps - before;
    };
    const double step = euler.longest_step();
    EXPECT_EQ(steps_in(0.0, step), late ? 2 : 1);
    EXPECT_EQ(steps_in(step, 3.9 * step), late ? 4 : 3);
    EXPECT_EQ(steps_in(3.9 * step, 4.4 * step), 1);
    EXPECT_EQ(steps_in(4.4 * step, 6.4 * step), 2);
  }
}

}  // namespace
}  // namespace perifrac
