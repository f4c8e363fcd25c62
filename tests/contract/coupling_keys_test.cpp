#include "coupling/coupling_keys.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/config/scene.hpp"

namespace perifrac {
namespace {

/// The options of a scene of 100 s whose section `coupling` has these lines.
CouplingOptions read(const std::string& lines) {
  const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
  const std::string path = testing::TempDir() + test->name() + ".yaml";
  std::ofstream(path) << "dimension: 2\n" << lines;
  const Catalogue catalogue = {
      {"",
       "",
       {{.path = "dimension", .type = KeyType::integer, .required = true, .meaning = "2 or 3"}}},
      {"coupling", "", coupling_keys()}};
  return read_coupling_options(read_scene(path, {}, catalogue).at("coupling"), 100.0);
}

TEST(CouplingKeys, DefaultsFollowFromTheSimulatedTime) {
  const CouplingOptions options = read("");
  EXPECT_DOUBLE_EQ(options.first_window, 1e-3);
  EXPECT_DOUBLE_EQ(options.window_growth, 1.1);
  EXPECT_DOUBLE_EQ(options.largest_window, 2.0);
  EXPECT_EQ(options.window, WindowType::schedule);
  EXPECT_EQ(options.split, Split::automatic);
  EXPECT_FALSE(options.max_iterations);
  EXPECT_EQ(options.retries, 8);
  EXPECT_DOUBLE_EQ(options.tolerance, 1e-4);
  EXPECT_EQ(options.acceleration, AccelerationType::anderson);
}

TEST(CouplingKeys, ReadsEachKey) {
  const CouplingOptions options = read(
      "coupling:\n"
      "  window: {type: one_step, first: 2 ms, growth: 1.5, largest: 0.5 s, retries: 3}\n"
      "  split: drained\n"
      "  iterations: {max: 30, tolerance: 1e-8}\n"
      "  acceleration: anderson\n");
  EXPECT_DOUBLE_EQ(options.first_window, 2e-3);
  EXPECT_DOUBLE_EQ(options.window_growth, 1.5);
  EXPECT_DOUBLE_EQ(options.largest_window, 0.5);
  EXPECT_EQ(options.window, WindowType::one_step);
  EXPECT_EQ(options.split, Split::drained);
  EXPECT_EQ(options.max_iterations, 30);
  EXPECT_EQ(options.retries, 3);
  EXPECT_DOUBLE_EQ(options.tolerance, 1e-8);
  EXPECT_EQ(options.acceleration, AccelerationType::anderson);
}

TEST(CouplingKeys, OneWindowGivenBoundsTheOther) {
  EXPECT_DOUBLE_EQ(read("coupling: {window: {first: 5 s}}\n").largest_window, 5.0);
  EXPECT_DOUBLE_EQ(read("coupling: {window: {largest: 1 us}}\n").first_window, 1e-6);
}

TEST(CouplingKeys, AFirstWindowAboveTheLargestIsRefusedWithItsPlace) {
  try {
    read("coupling:\n  window: {first: 2 s, largest: 1 s}\n");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr(".yaml:3:"));
    EXPECT_THAT(error.what(), testing::HasSubstr("coupling.window.first"));
  }
}

}  // namespace
}  // namespace perifrac
