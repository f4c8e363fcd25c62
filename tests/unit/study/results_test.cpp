#include "app/study/results.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/study/sentences.hpp"
#include "tests/unit/study/study_fixture.hpp"

namespace perifrac::test {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::SizeIs;

/// The two axes of the fixture: errors fall with dx^2, explicit costs dx^-4 and cvode 3 dx^-2.
class results : public testing::Test {
 protected:
  void SetUp() override { take(two_axes + error_lines + "accuracies: [1e-2, 5e-3, 1e-6]\n"); }

  void take(const std::string& text) {
    study_.emplace(fixture_.read(scene_line + text));
    matrix_ = expand(*study_);
    records_.assign(matrix_.variants.size(),
                    {.made_from = {}, .status = VariantStatus::done, .runs = {{{"elapsed", 1.0}}}});
    points_.clear();
    for (std::size_t i = 0; i < matrix_.variants.size(); ++i) {
      const Variant& variant = matrix_.variants[i];
      const double dx = study_->axes[1].values[variant.choice[1]].number;
      StudyPoint point{.variant = &variant, .record = &records_[i]};
      point.error.error = 1e-2 * dx * dx;
      point.cost.median = variant.choice[0] == 0 ? std::pow(dx, -4.0) : 3.0 * std::pow(dx, -2.0);
      points_.push_back(point);
    }
  }

  StudyFixture fixture_;
  std::optional<Study> study_;
  Matrix matrix_;
  std::vector<VariantRecord> records_;
  std::vector<StudyPoint> points_;
};

TEST_F(results, name_front_orders_and_crossing) {
  const StudyResults found = conclude(*study_, points_);
  ASSERT_THAT(found.rankings, SizeIs(1));
  EXPECT_THAT(found.rankings[0].front, ElementsAre(0, 1, 5));
  ASSERT_THAT(found.orders, SizeIs(2));
  EXPECT_NEAR(*found.orders[0].error, 2.0, 1e-9);
  EXPECT_NEAR(*found.orders[0].cost, -4.0, 1e-9);
  ASSERT_THAT(found.crossings, SizeIs(1));
  EXPECT_NEAR(found.crossings[0].places[0], 1.0 / std::sqrt(3.0), 1e-9);
  EXPECT_EQ(found.crossings[0].values.first, "cvode");
}

TEST_F(results, say_the_cheapest_for_each_accuracy) {
  const auto said = sentences(*study_, conclude(*study_, points_), {});
  EXPECT_EQ(said[0],
            "To reach 0.01 the cheapest is explicit-dx_1m: 1 s; the next, cvode-dx_1m, takes 3.0 "
            "times as long.");
  EXPECT_EQ(said[1],
            "To reach 0.005 the cheapest is cvode-dx_50cm: 12 s; the next, explicit-dx_50cm, takes "
            "1.3 times as long.");
  EXPECT_EQ(said[2], "No variant reaches 1e-06; the best, cvode-dx_50cm, has 2.5e-03 in 12 s.");
  EXPECT_THAT(said, Contains("Along dx, cvode costs less below 0.58 m, explicit above."));
}

TEST_F(results, keep_what_failed_as_points_and_say_so) {
  records_[1].status = VariantStatus::diverged;
  records_[1].message = "pore_pressure is not finite";
  points_[1].error = {{}, "diverged"};
  const StudyResults found = conclude(*study_, points_);
  EXPECT_THAT(found.points, SizeIs(6));
  EXPECT_THAT(found.rankings[0].front, ElementsAre(0, 4, 5));
  EXPECT_THAT(sentences(*study_, found, {"a-b"}),
              testing::IsSupersetOf(
                  {std::string("1 diverged: explicit-dx_1m (pore_pressure is not finite)."),
                   std::string("Left out by the study: a-b.")}));
}

TEST_F(results, do_not_rank_different_problems) {
  const std::string problem =
      "axes:\n"
      "  - {name: integrator, problem: true, values: {explicit: {pore_flow.integrator.type: "
      "explicit}, cvode: {}}}\n"
      "  - {name: dx, key: body.spacing, values: [2 m, 1 m]}\n";
  take(problem + error_lines + "accuracies: [2e-2]\n");
  const StudyResults found = conclude(*study_, points_);
  ASSERT_THAT(found.rankings, SizeIs(2));
  EXPECT_THAT(found.rankings[1].front, ElementsAre(2, 3));
  EXPECT_THAT(found.crossings, SizeIs(0));
  EXPECT_THAT(sentences(*study_, found, {})[0],
              HasSubstr("To reach 0.02 (integrator explicit) the cheapest is explicit-dx_1m"));
}

}  // namespace
}  // namespace perifrac::test
