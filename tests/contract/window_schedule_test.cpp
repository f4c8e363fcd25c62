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
    const double end = schedule.end(t, stop, stable);
    EXPECT_LE(end, stop);
    lengths.push_back(end - t);
    t = end;
    schedule.grow();
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
  const auto found = lengths({1.0, 2.0, 5.0}, 0.0, 22.0, unlimited);
  EXPECT_THAT(found, ElementsAre(1.0, 2.0, 4.0, 5.0, 5.0, 5.0));
}

TEST(WindowSchedule, HalvesARestOfLessThanTwoWindows) {
  EXPECT_THAT(lengths({1.0, 1.0, 1.0}, 0.0, 3.5, unlimited), ElementsAre(1.0, 1.0, 0.75, 0.75));
}

TEST(WindowSchedule, LeavesNoSliversAndHitsTheStop) {
  for (const double stop : {0.3, 1.0, 9.99, 10.01, 10.0}) {
    const auto found = lengths({1.0, 1.0, 1.0}, 0.0, stop, unlimited);
    EXPECT_THAT(found, Each(Ge(std::min(0.5, stop)))) << stop;
    EXPECT_THAT(found, Each(Le(1.0 + 1e-9))) << stop;
  }
  // 0.1 ten times is not 1 in binary: no eleventh window of 1e-16.
  EXPECT_EQ(lengths({0.1, 1.0, 0.1}, 0.0, 1.0, unlimited).size(), 10u);
}

TEST(WindowSchedule, KeepsWithinTheModulesStableStep) {
  EXPECT_THAT(lengths({1.0, 2.0, 8.0}, 0.0, 20.0, 1.5), Each(Le(1.5)));
}

TEST(WindowSchedule, StartsOverAfterASuddenLoad) {
  WindowSchedule schedule(1.0, 2.0, 8.0);
  schedule.grow();
  schedule.start_over();
  EXPECT_DOUBLE_EQ(schedule.end(5.0, 100.0, unlimited), 6.0);
}

}  // namespace
}  // namespace perifrac
