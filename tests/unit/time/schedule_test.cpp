#include "core/time/schedule.hpp"

#include <gtest/gtest.h>

#include "core/time/scheduled_vector.hpp"

namespace perifrac {
namespace {

TEST(Schedule, IsOneWhereNothingIsSaid) {
  EXPECT_TRUE(Schedule().is_constant());
  EXPECT_EQ(Schedule().factor(-3.0), 1.0);
}

TEST(Schedule, TellsWhereItsRateChanges) {
  EXPECT_TRUE(Schedule().break_points().empty());
  ScheduledVector sum(1);
  sum.add(Schedule::ramp(4.0), Eigen::VectorXd::Ones(1));
  sum.add(Schedule::table({1.0, 4.0}, {0.0, 1.0}), Eigen::VectorXd::Ones(1));
  EXPECT_EQ(sum.break_points(), (std::vector{0.0, 1.0, 4.0}));
  EXPECT_EQ(sum.at(2.5)[0], 2.5 / 4.0 + 0.5);
}

TEST(Schedule, RampsFromZeroAndStays) {
  const Schedule ramp = Schedule::ramp(4.0);
  EXPECT_EQ(ramp.factor(0.0), 0.0);
  EXPECT_EQ(ramp.factor(1.0), 0.25);
  EXPECT_EQ(ramp.factor(4.0), 1.0);
  EXPECT_EQ(ramp.factor(9.0), 1.0);
}

TEST(Schedule, IsLinearBetweenTheTimesOfATableAndConstantBeyond) {
  const Schedule table = Schedule::table({1.0, 3.0, 4.0}, {2.0, 6.0, 0.0});
  EXPECT_EQ(table.factor(0.0), 2.0);
  EXPECT_EQ(table.factor(2.0), 4.0);
  EXPECT_EQ(table.factor(3.5), 3.0);
  EXPECT_EQ(table.factor(8.0), 0.0);
}

TEST(Schedule, FollowsAFactorThatIsGiven) {
  const auto given = std::make_shared<double>(1.0);
  Schedule schedule;
  Schedule ramp = Schedule::ramp(4.0);
  schedule.follow(given);
  ramp.follow(given);
  EXPECT_FALSE(schedule.is_constant());
  ScheduledVector sum(1);
  sum.add(schedule, Eigen::VectorXd::Ones(1));
  sum.add(ramp, Eigen::VectorXd::Ones(1));
  *given = 3.0;
  EXPECT_EQ(sum.at(1.0)[0], 3.0 + 0.75);
  EXPECT_EQ(ramp.integral(0.0, 4.0), 6.0);
}

TEST(Schedule, IntegratesAcrossItsBreaks) {
  EXPECT_EQ(Schedule().integral(1.0, 3.0), 2.0);
  EXPECT_EQ(Schedule::ramp(4.0).integral(2.0, 6.0), 1.5 + 2.0);
  EXPECT_EQ(Schedule::table({1.0, 3.0, 4.0}, {2.0, 6.0, 0.0}).integral(0.0, 5.0), 2.0 + 8.0 + 3.0);
  EXPECT_EQ(Schedule::growth(2.0).integral(1.0, 3.0), 8.0);
}

TEST(Schedule, GrowsWithoutEnd) {
  const Schedule growth = Schedule::growth(3.0);
  EXPECT_FALSE(growth.is_constant());
  EXPECT_EQ(growth.factor(0.0), 0.0);
  EXPECT_EQ(growth.factor(0.5), 1.5);
  EXPECT_EQ(growth.factor(1e6), 3e6);
  EXPECT_EQ(Schedule::growth(0.0).factor(2.0), 0.0);
}

TEST(ScheduledVector, AddsWhatEachScheduleAllows) {
  ScheduledVector sum(2);
  sum.add({}, Eigen::Vector2d(1.0, 0.0));
  EXPECT_TRUE(sum.is_constant());
  sum.add(Schedule::ramp(2.0), Eigen::Vector2d(0.0, 8.0));
  EXPECT_FALSE(sum.is_constant());
  Eigen::VectorXd value(2);
  sum.at(0.5, value);
  EXPECT_EQ(value, Eigen::Vector2d(1.0, 2.0));
}

TEST(ScheduledVector, AddsAMatrixTimesAnother) {
  ScheduledVector other(2);
  other.add({}, Eigen::Vector2d(1.0, 2.0));
  other.add(Schedule::ramp(2.0), Eigen::Vector2d(4.0, 0.0));
  Eigen::SparseMatrix<double> matrix(3, 2);
  matrix.insert(0, 1) = 10.0;
  matrix.insert(2, 0) = 1.0;
  ScheduledVector sum(3);
  sum.add({}, Eigen::Vector3d(0.0, 7.0, 0.0));
  sum.add(matrix, other);
  Eigen::VectorXd value(3);
  sum.at(1.0, value);
  EXPECT_EQ(value, Eigen::Vector3d(20.0, 7.0, 3.0));
}

}  // namespace
}  // namespace perifrac
