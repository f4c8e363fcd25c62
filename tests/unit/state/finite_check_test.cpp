#include "core/state/finite_check.hpp"

#include <limits>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

const std::vector<double> x{0.0, 1.0, 2.0};
const std::vector<double> y{5.0, 6.0, 7.5};
const PointSet points{.name = "solid", .dimension = 2, .position = {x, y}, .count = 3};

std::optional<NumericalError> check(std::vector<double> values, const PointSet* on = nullptr) {
  FiniteCheck checker(12.5, [on](std::string_view) { return on; });
  try {
    checker.enter("solid");
    checker.visit("displacement", values);
  } catch (const NumericalError& error) {
    return error;
  }
  return {};
}

TEST(FiniteCheck, LetsFiniteValuesPass) {
  constexpr double largest = std::numeric_limits<double>::max();
  EXPECT_FALSE(check({0.0, -0.0, largest, -largest, 5e-324}));
  EXPECT_FALSE(check({}));
  std::vector<std::int64_t> integers{std::numeric_limits<std::int64_t>::min()};
  FiniteCheck checker(0.0);
  EXPECT_NO_THROW(checker.visit("ids", integers));
}

TEST(FiniteCheck, NamesFieldPointPositionAndTime) {
  // Component by component: the fifth value is the y displacement of the second point.
  const auto error = check({0, 0, 0, 0, nan, infinity}, &points);
  ASSERT_TRUE(error);
  EXPECT_EQ(error->field(), "solid/displacement");
  EXPECT_EQ(error->place(), "point 1 at (1, 6) m");
  EXPECT_EQ(error->time(), 12.5);
  EXPECT_THAT(error->what(), testing::HasSubstr("not a number"));
}

TEST(FiniteCheck, FindsBothInfinities) {
  EXPECT_THAT(check({0, infinity, 0}, &points)->what(), testing::HasSubstr("infinite"));
  EXPECT_EQ(check({0, 0, -infinity}, &points)->place(), "point 2 at (2, 7.5) m");
}

TEST(FiniteCheck, GivesThePlaceInAnArrayThatIsNotOnPoints) {
  EXPECT_EQ(check({0, 0, 0, nan}, &points)->place(), "value 3 of 4");
  EXPECT_EQ(check({nan})->place(), "value 0 of 1");
}

TEST(FiniteCheck, NamesThePointsOfTheModuleThatIsVisited) {
  const std::vector<double> far{10.0, 11.0, 12.0, 13.0};
  const PointSet four{.name = "fluid", .dimension = 2, .position = {far, far}, .count = 4};
  FiniteCheck checker(0.0, [&](std::string_view field) {
    return field.starts_with("fluid/") ? &four : field.starts_with("solid/") ? &points : nullptr;
  });
  const auto place_in = [&](const std::string& module, std::vector<double> values) {
    checker.enter(module);
    try {
      checker.visit("density", values);
    } catch (const NumericalError& error) {
      checker.leave();
      return error.place();
    }
    return std::string("nowhere");
  };
  const std::vector<double> fourth{0, 0, 0, nan, 0, 0, 0, 0, 0, 0, 0, 0};
  EXPECT_EQ(place_in("solid", fourth), "point 0 at (0, 5) m");
  EXPECT_EQ(place_in("fluid", fourth), "point 3 at (13, 13) m");
  EXPECT_EQ(place_in("coupling", fourth), "value 3 of 12");
}

TEST(FiniteCheck, TakesASetWithoutPoints) {
  const PointSet none{.name = "fluid", .dimension = 2, .count = 0};
  EXPECT_EQ(check({nan}, &none)->place(), "value 0 of 1");
}

TEST(FiniteCheck, ChecksScalars) {
  double scalar = nan;
  FiniteCheck checker(1.0);
  EXPECT_THROW(checker.visit("inflow", scalar), NumericalError);
}

}  // namespace
}  // namespace perifrac
