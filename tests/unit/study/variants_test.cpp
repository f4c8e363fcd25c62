#include "app/study/variants.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "app/study/record.hpp"
#include "tests/unit/study/study_fixture.hpp"

namespace perifrac::test {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

std::vector<std::string> names_of(const Matrix& matrix) {
  std::vector<std::string> names;
  for (const Variant& variant : matrix.variants) names.push_back(variant.name);
  return names;
}

class expand_study : public testing::Test {
 protected:
  Matrix matrix(const std::string& text) const { return expand(fixture_.read(scene_line + text)); }
  std::string refusal(const std::string& text) const {
    try {
      matrix(text);
    } catch (const InputError& error) {
      return fixture_.without_folder(error.what());
    }
    return "accepted";
  }
  StudyFixture fixture_;
};

TEST_F(expand_study, makes_every_combination_under_readable_names) {
  EXPECT_THAT(names_of(matrix(two_axes + error_lines)),
              ElementsAre("explicit-dx_2m", "explicit-dx_1m", "explicit-dx_50cm", "cvode-dx_2m",
                          "cvode-dx_1m", "cvode-dx_50cm"));
}

TEST_F(expand_study, sets_what_all_share_and_then_what_differs) {
  const Matrix made = matrix("set: {time.end: 5 s, body.spacing: 4 m, output.times: [1 s, 2 s]}\n" +
                             two_axes + error_lines);
  EXPECT_THAT(assignments(made.variants[0]),
              ElementsAre("time.end=5 s", "output.times=[1 s, 2 s]",
                          "pore_flow.integrator.type=explicit", "body.spacing=2 m"));
  EXPECT_EQ(made.variants[0].threads, 1);
}

TEST_F(expand_study, takes_threads_and_scene_as_axes) {
  const Matrix made = matrix(
      "axes:\n"
      "  - {name: threads, key: threads, values: [1, 2]}\n"
      "  - {name: solid, values: {still: {}, moving: {scene: " PERIFRAC_SOURCE_DIR
      "/configs/mandel_dynamic.yaml}}}\n" +
      error_lines);
  EXPECT_THAT(names_of(made), ElementsAre("threads_1-still", "threads_1-moving", "threads_2-still",
                                          "threads_2-moving"));
  EXPECT_EQ(made.variants[2].threads, 2);
  EXPECT_THAT(made.variants[3].scene, HasSubstr("mandel_dynamic.yaml"));
  EXPECT_THAT(made.variants[3].overrides, IsEmpty());
  EXPECT_THAT(refusal("set: {threads: many}\n" + two_axes + error_lines),
              "study.yaml:2:16: threads: 'many' is no number of threads; expected 1 to 1024");
}

TEST_F(expand_study, leaves_out_what_it_is_told_to) {
  const Matrix made =
      matrix(two_axes + "skip: [{integrator: explicit, dx: [1 m, 50 cm]}]\n" + error_lines);
  EXPECT_THAT(names_of(made),
              ElementsAre("explicit-dx_2m", "cvode-dx_2m", "cvode-dx_1m", "cvode-dx_50cm"));
  EXPECT_THAT(made.left_out, ElementsAre("explicit-dx_1m", "explicit-dx_50cm"));
  EXPECT_THAT(refusal(two_axes + "skip: [{dx: [2 m, 1 m, 50 cm]}]\n" + error_lines),
              HasSubstr("leaves nothing"));
}

TEST_F(expand_study, keeps_what_a_scene_refuses_with_its_message) {
  const Matrix made =
      matrix("axes: [{name: dx, key: body.spacing, values: [1 m, -1 m, 1 kg]}]\n" + error_lines);
  EXPECT_THAT(made.variants[0].problem, IsEmpty());
  EXPECT_EQ(
      fixture_.without_folder(made.variants[1].problem),
      "study.yaml:2:52: body.spacing: '-1 m' is out of range; expected a value in (0, inf) m");
  EXPECT_THAT(made.variants[2].problem, HasSubstr("study.yaml:2:58: body.spacing: "));
}

TEST_F(expand_study, refuses_where_nothing_can_be_run) {
  EXPECT_EQ(
      refusal("axes: [{name: dx, key: body.spacing, values: [-1 m]}]\n" + error_lines),
      "study.yaml:2:47: body.spacing: '-1 m' is out of range; expected a value in (0, inf) m");
}

TEST_F(expand_study, refuses_two_variants_of_one_name) {
  EXPECT_THAT(refusal("axes: [{name: way, values: {a b: {}, ab: {}}}]\n" + error_lines),
              HasSubstr("two variants are called 'ab'"));
}

TEST_F(expand_study, adds_the_finer_run) {
  const Matrix made = matrix(
      two_axes +
      "error: {against: finer, columns: [fluid_mass_stored], finer: {body.spacing: 25 cm}}\n");
  EXPECT_EQ(made.variants.back().name, "finer");
  EXPECT_THAT(made.variants.back().choice, IsEmpty());
  EXPECT_THAT(assignments(made.variants.back()), ElementsAre("body.spacing=25 cm"));
}

}  // namespace
}  // namespace perifrac::test
