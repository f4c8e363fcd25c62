#include "app/study/record.hpp"

#include <cmath>
#include <fstream>

#include <gtest/gtest.h>

#include "tests/unit/study/study_fixture.hpp"

namespace perifrac::test {
namespace {

class record : public testing::Test {
 protected:
  Study study(const std::string& more) const {
    return fixture_.read(scene_line + two_axes + error_lines + more);
  }
  static VariantRecord done(std::size_t runs, double elapsed) {
    return {.made_from = {},
            .status = VariantStatus::done,
            .runs = std::vector<nlohmann::json>(runs, {{"elapsed", elapsed}})};
  }
  StudyFixture fixture_;
};

TEST_F(record, comes_back_where_it_was_made_from_the_same) {
  const Matrix matrix = expand(study(""));
  const VariantRecord made{.made_from = made_from(matrix.variants[1]),
                           .status = VariantStatus::killed,
                           .message = "by signal 9",
                           .budget = INFINITY,
                           .runs = {{{"elapsed", 2.5}}}};
  write_record(fixture_.folder(), made);
  const VariantRecord kept = read_record(fixture_.folder(), matrix.variants[1]);
  EXPECT_EQ(kept.status, VariantStatus::killed);
  EXPECT_EQ(kept.message, "by signal 9");
  EXPECT_TRUE(std::isinf(kept.budget));
  EXPECT_EQ(kept.runs, made.runs);
  EXPECT_EQ(read_record(fixture_.folder(), matrix.variants[2]).status, VariantStatus::not_run);
  std::ofstream(fixture_.folder() / "record.json") << "{";
  EXPECT_EQ(read_record(fixture_.folder(), matrix.variants[1]).status, VariantStatus::not_run);
}

TEST_F(record, is_finished_after_its_repetitions_unless_one_is_long) {
  const Study often = study("repetitions: 3\nrepeat_up_to: 5 s\n");
  EXPECT_FALSE(is_finished(done(2, 1.0), often));
  EXPECT_TRUE(is_finished(done(3, 1.0), often));
  EXPECT_TRUE(is_finished(done(1, 6.0), often));
}

TEST_F(record, over_budget_is_taken_up_again_under_a_larger_one) {
  VariantRecord late = done(1, 10.0);
  late.status = VariantStatus::over_budget;
  late.budget = 10.0;
  EXPECT_TRUE(is_finished(late, study("budget: {each: 10 s}\n")));
  EXPECT_FALSE(is_finished(late, study("budget: {each: 20 s}\n")));
  EXPECT_FALSE(is_finished(late, study("")));
}

}  // namespace
}  // namespace perifrac::test
