#include "app/study/evaluation.hpp"

#include <gtest/gtest.h>

#include "tests/unit/study/study_fixture.hpp"

namespace perifrac {
namespace {

TEST(spread, is_median_and_ends) {
  const Spread odd = spread({3.0, 1.0, 7.0});
  EXPECT_EQ(odd.median, 3.0);
  EXPECT_EQ(odd.least, 1.0);
  EXPECT_EQ(odd.most, 7.0);
  EXPECT_EQ(spread({4.0, 1.0}).median, 2.5);
  EXPECT_EQ(spread({}).median, 0.0);
}

TEST(cost, is_of_what_the_study_names_and_leaves_out_the_warm_up) {
  const test::StudyFixture fixture;
  const auto cost = [&](const std::string& keys) {
    const Study study =
        fixture.read(test::scene_line + test::two_axes + "error: {against: finer, columns: [p], " +
                     "finer: {body.spacing: 25 cm}}\n" + keys);
    const Matrix matrix = expand(study);
    const auto run = [](double wall) {
      return nlohmann::json{
          {"elapsed", 9.0},
          {"wall_time", wall},
          {"output_time", 0.5},
          {"cpu_time", 2.0 * wall},
          {"modules", {{{"name", "solid"}, {"wall_time", 1.0}, {"cpu_time", 1.5}}}}};
    };
    std::vector<VariantRecord> records(
        matrix.variants.size(),
        {.made_from = {}, .status = VariantStatus::done, .runs = {run(80.0), run(3.0), run(5.0)}});
    records.back().status = VariantStatus::killed;  // the finer run: no history is asked for
    return evaluate(study, matrix.variants, records, {.folder = fixture.folder()})[0].cost;
  };
  EXPECT_EQ(cost("").median, 3.5);
  EXPECT_EQ(cost("").most, 4.5);
  EXPECT_EQ(cost("cost: {time: cpu}\n").median, 8.0);
  EXPECT_EQ(cost("cost: {of: solid}\n").median, 1.0);
  EXPECT_EQ(cost("cost: {of: solid, time: cpu}\n").median, 1.5);
}

}  // namespace
}  // namespace perifrac
