#include "coupling/window_schedule.hpp"

#include <limits>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

constexpr double unlimited = std::numeric_limits<double>::infinity();

std::vector<double> lengths(WindowSchedule schedule, double begin, double stop, double stable) {
  std::vector<double> lengths;
  for (double t = begin; t < stop;) {
    const double end = schedule.end(t, stop);
    EXPECT_LE(end, stop);
    lengths.push_back(end - t);
    t = end;
    schedule.grow(stable);
    if (lengths.size() > 10000) break;
  }
  return lengths;
}

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::Ge;
using testing::Le;

TEST(WindowSchedule, GrowsToTheLargest) {
  const auto found = lengths({WindowType::schedule, 1.0, 2.0, 5.0}, 0.0, 22.0, unlimited);
  EXPECT_THAT(found, ElementsAre(1.0, 2.0, 4.0, 5.0, 5.0, 5.0));
}

TEST(WindowSchedule, HalvesARestOfLessThanTwoWindows) {
  EXPECT_THAT(lengths({WindowType::schedule, 1.0, 1.0, 1.0}, 0.0, 3.5, unlimited),
              ElementsAre(1.0, 1.0, 0.75, 0.75));
}

TEST(WindowSchedule, LeavesNoSliversAndHitsTheStop) {
  for (const double stop : {0.3, 1.0, 9.99, 10.01, 10.0}) {
    const auto found = lengths({WindowType::schedule, 1.0, 1.0, 1.0}, 0.0, stop, unlimited);
    EXPECT_THAT(found, Each(Ge(std::min(0.5, stop)))) << stop;
    EXPECT_THAT(found, Each(Le(1.0 + 1e-9))) << stop;
  }
  // 0.1 ten times is not 1 in binary: no eleventh window of 1e-16.
  EXPECT_EQ(lengths({WindowType::schedule, 0.1, 1.0, 0.1}, 0.0, 1.0, unlimited).size(), 10u);
}

TEST(WindowSchedule, LeavesStableStepsToTheModules) {
  EXPECT_THAT(lengths({WindowType::schedule, 1.0, 2.0, 4.0}, 0.0, 15.0, 1.5),
              ElementsAre(1.0, 2.0, 4.0, 4.0, 4.0));
}

TEST(WindowSchedule, OneStepFollowsTheStableStepUpToTheLargest) {
  WindowSchedule schedule(WindowType::one_step, 1.0, 2.0, 8.0);
  schedule.start_over(3.0);
  EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), 3.0);
  schedule.grow(2.0);
  EXPECT_DOUBLE_EQ(schedule.end(3.0, 100.0), 5.0);
  schedule.grow(unlimited);
  EXPECT_DOUBLE_EQ(schedule.end(5.0, 100.0), 13.0);
}

TEST(WindowSchedule, ComesBackFromACutAsFarAsWindowsAreEasy) {
  WindowSchedule schedule(WindowType::schedule, 1.0, 2.0, 8.0);
  schedule.grow(unlimited);
  schedule.cut(2.0);
  EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), 1.0);
  schedule.grow(unlimited, false);
  EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), 1.0);
  for (const double length : {1.2, 1.44, 1.728, 2.0, 4.0, 8.0}) {
    schedule.grow(unlimited);
    EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), length);
  }
  schedule.cut(0.5);  // what was tried may have been shorter, as before an output
  EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), 0.25);
  schedule.start_over(unlimited);
  EXPECT_DOUBLE_EQ(schedule.end(0.0, 100.0), 1.0);
}

TEST(WindowSchedule, StartsOverAfterASuddenLoad) {
  WindowSchedule schedule(WindowType::schedule, 1.0, 2.0, 8.0);
  schedule.grow(unlimited);
  schedule.start_over(unlimited);
  EXPECT_DOUBLE_EQ(schedule.end(5.0, 100.0), 6.0);
}

TEST(WindowSchedule, IsShortenedAsFarAsAllowedAndComesBack) {
  WindowSchedule schedule(WindowType::schedule, 8.0, 1.0, 8.0);
  const auto next = [&] { return schedule.end(0.0, 1e3); };
  schedule.shorten(0.75, 0.25);
  EXPECT_DOUBLE_EQ(next(), 6.0);
  schedule.shorten(0.5, 0.25);
  EXPECT_DOUBLE_EQ(next(), 3.0);
  schedule.shorten(0.5, 0.25);
  EXPECT_DOUBLE_EQ(next(), 2.0);
  schedule.cut(2.0);
  schedule.shorten(0.5, 0.25);  // no longer than what failed left it
  EXPECT_DOUBLE_EQ(next(), 1.0);
  schedule.grow(unlimited, false);
  EXPECT_DOUBLE_EQ(next(), 1.0);
  for (int n = 0; n < 20; ++n) schedule.grow(unlimited);
  EXPECT_DOUBLE_EQ(next(), 8.0);
}

}  // namespace
}  // namespace perifrac
