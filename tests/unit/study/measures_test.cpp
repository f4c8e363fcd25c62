#include "app/study/measures.hpp"

#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/unit/study/study_fixture.hpp"

namespace perifrac::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

const nlohmann::json summary = nlohmann::json::parse(R"({"reference": {
  "table": [{"time": 1.0, "dimensionless_time": 0.1, "pressure_error": 4e-3},
            {"time": 2.0, "dimensionless_time": 0.2, "pressure_error": 3e-3},
            {"time": 3.0, "dimensionless_time": 0.3, "pressure_error": null}],
  "quantities": [{"name": "peak", "max_error": 5e-4}]}})");

TEST(reference_error, is_the_largest_or_the_mean_of_the_times_compared) {
  ErrorMeasure measure{.against = "reference", .quantity = "pressure_error"};
  EXPECT_EQ(*reference_error(summary, measure).error, 4e-3);
  measure.largest = false;
  EXPECT_NEAR(*reference_error(summary, measure).error, std::sqrt(12.5e-6), 1e-12);
  measure.from = 1.5;
  EXPECT_NEAR(*reference_error(summary, measure).error, 3e-3, 1e-15);
  measure.from = 2.5;
  EXPECT_FALSE(reference_error(summary, measure).error);
  EXPECT_THAT(reference_error(summary, measure).why, HasSubstr("between the times"));
}

TEST(reference_error, may_be_one_number_of_the_whole_run) {
  EXPECT_EQ(*reference_error(summary, {.against = "reference", .quantity = "peak"}).error, 5e-4);
  EXPECT_THAT(reference_quantities(summary), ElementsAre("pressure_error", "peak"));
  EXPECT_FALSE(reference_error(nlohmann::json::object(), {.against = "reference"}).error);
}

class histories : public testing::Test {
 protected:
  /// f(t) = t + part at the times of `count` equal steps to 8 s.
  HistoryTable table(int count, double part) const {
    const auto file = fixture_.folder() / "history.csv";
    std::ofstream stream(file);
    stream << "time [s],step,pressure at a [Pa],mass [kg/m]\n";
    for (int i = 0; i <= count; ++i) {
      const double t = 8.0 * i / count;
      stream << t << ',' << i << ',' << t + part << ",1\n";
    }
    stream.close();
    return HistoryTable(file);
  }

  StudyFixture fixture_;
};

TEST_F(histories, are_compared_over_the_largest_value_of_the_finer) {
  const ErrorMeasure measure{.against = "finer", .columns = {"pressure at a"}};
  EXPECT_NEAR(*distance(table(4, 0.4), table(8, 0.0), measure).error, 0.4 / 8.0, 1e-12);
  EXPECT_NEAR(
      *distance(table(4, 0.4), table(8, 0.0),
                {.against = "finer", .columns = {"pressure at a [Pa]", "mass"}, .largest = false})
           .error,
      0.05 / std::sqrt(2.0), 1e-12);
}

TEST_F(histories, without_the_column_have_no_distance) {
  const auto found =
      distance(table(4, 0.4), table(8, 0.0), {.against = "finer", .columns = {"presure at a"}});
  EXPECT_FALSE(found.error);
  EXPECT_THAT(found.why, HasSubstr("did you mean 'pressure at a'?"));
}

TEST_F(histories, along_an_axis_give_order_and_errors) {
  std::vector<HistoryTable> tables;
  for (const double h : {8.0, 4.0, 2.0, 1.0}) tables.push_back(table(8, 0.01 * h * h));
  const Extrapolated found = richardson(tables, {8.0, 4.0, 2.0, 1.0},
                                        {.against = "richardson", .columns = {"pressure at a"}});
  ASSERT_TRUE(found.order);
  EXPECT_NEAR(*found.order, 2.0, 1e-9);
  EXPECT_NEAR(*found.errors[0].error, 0.64 / 8.01, 1e-9);
  EXPECT_NEAR(*found.errors[3].error, 0.01 / 8.01, 1e-9);
}

TEST_F(histories, that_tend_to_nothing_have_no_error) {
  const ErrorMeasure measure{.against = "richardson", .columns = {"pressure at a"}};
  const auto same =
      richardson({table(8, 0.1), table(8, 0.1), table(8, 0.1)}, {4.0, 2.0, 1.0}, measure);
  EXPECT_FALSE(same.errors[2].error);
  const auto uneven =
      richardson({table(8, 0.3), table(8, 0.2), table(8, 0.15)}, {4.0, 3.0, 1.0}, measure);
  EXPECT_FALSE(uneven.errors[2].error);
  EXPECT_FALSE(richardson({table(8, 0.1), table(8, 0.05)}, {2.0, 1.0}, measure).errors[0].error);
}

}  // namespace
}  // namespace perifrac::test
