#include "app/study/study_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/study/study_fixture.hpp"

namespace perifrac::test {
namespace {

class study_file : public testing::Test {
 protected:
  std::string refusal(const std::string& text) const { return fixture_.refusal(scene_line + text); }
  StudyFixture fixture_;
};

TEST_F(study_file, is_read_whole) {
  const Study study =
      fixture_.read(scene_line + two_axes +
                    "error: {against: reference, quantity: plate_error, norm: rms, from: 1 min}\n"
                    "accuracies: [1e-4, 1e-2]\n"
                    "budget: {each: 2 min}\n"
                    "compare: dx\n");
  EXPECT_EQ(study.title, "study");
  ASSERT_EQ(study.axes.size(), 2u);
  EXPECT_FALSE(study.axes[0].is_numeric());
  EXPECT_TRUE(study.axes[1].is_numeric());
  EXPECT_EQ(study.axes[1].unit, "m");
  EXPECT_EQ(study.axes[1].values[2].number, 0.5);
  EXPECT_FALSE(study.error.largest);
  EXPECT_EQ(study.error.from, 60.0);
  EXPECT_EQ(study.budget_each, 120.0);
  EXPECT_THAT(study.accuracies, testing::ElementsAre(1e-2, 1e-4));
  EXPECT_EQ(study.compared, "dx");
}

TEST_F(study_file, names_of_a_map_may_be_quantities) {
  const Study study = fixture_.read(
      scene_line + "axes: [{name: m, unit: '1', values: {1: {}, 2: {body.horizon_ratio: 2}}}]\n" +
      error_lines);
  EXPECT_TRUE(study.axes[0].is_numeric());
  EXPECT_EQ(refusal("axes: [{name: m, unit: s, values: {1 m: {}}}]\n" + error_lines).substr(0, 16),
            "study.yaml:2:36:");
}

TEST_F(study_file, mistakes_get_one_line_with_place_and_nearest_name) {
  EXPECT_EQ(refusal("axis: []\n" + error_lines),
            "study.yaml:2:1: unknown key 'axis'; expected one of: title, scene, set, axes, skip, "
            "compare, accuracies, repetitions, ...; did you mean 'axes'?");
  EXPECT_EQ(refusal(error_lines),
            "study.yaml:1:1: no axes; expected a list 'axes' of what is varied");
  EXPECT_EQ(refusal(two_axes),
            "study.yaml:1:1: missing key 'error.against'; expected one of: "
            "reference, finer, richardson");
  EXPECT_EQ(refusal(two_axes + "error: {against: refrence}\n"),
            "study.yaml:8:18: error.against: unknown word 'refrence'; expected one of: reference, "
            "finer, richardson; did you mean 'reference'?");
  EXPECT_EQ(refusal(two_axes + error_lines + "compare: dy\n"),
            "study.yaml:9:10: compare: unknown name 'dy'; expected one of: integrator, dx; did you "
            "mean 'dx'?");
  EXPECT_EQ(refusal(two_axes + error_lines + "budget: {each: 2 m}\n").substr(0, 29),
            "study.yaml:9:16: budget.each:");
}

TEST_F(study_file, keys_of_the_scene_must_be_known) {
  EXPECT_EQ(
      refusal("set: {body.spacng: 1 m}\n" + two_axes + error_lines),
      "study.yaml:2:7: unknown key 'spacng' of the scene; expected one of: shape, size, radius, "
      "part, spacing, jitter, seed, volumes, ...; did you mean 'spacing'?");
  EXPECT_EQ(
      refusal("axes: [{name: a, key: body.spacng, values: [1 m]}]\n" + error_lines).substr(0, 49),
      "study.yaml:2:23: axes[0].key: unknown name 'spacn");
}

TEST_F(study_file, values_of_an_axis_differ_and_belong_to_a_key) {
  EXPECT_EQ(refusal("axes: [{name: a, key: body.spacing, values: [1 m, 1 m]}]\n" + error_lines),
            "study.yaml:2:45: axes[0].values: '1 m' comes twice; expected values that differ");
  EXPECT_EQ(refusal("axes: [{name: a, values: [1 m]}]\n" + error_lines),
            "study.yaml:2:26: axes[0].values: is a list; expected a key beside it that takes these "
            "values");
  EXPECT_EQ(
      refusal("axes: [{name: a, values: {x: 1 m}}]\n" + error_lines),
      "study.yaml:2:30: '1 m' is a single value; expected a map of keys of the scene, such as "
      "{body.spacing: 1 m}");
}

TEST_F(study_file, combinations_left_out_must_be_there) {
  EXPECT_EQ(refusal(two_axes + "skip: [{dy: 1 m}]\n" + error_lines),
            "study.yaml:8:9: no axis 'dy'; expected one of: integrator, dx; did you mean 'dx'?");
  EXPECT_EQ(refusal(two_axes + "skip: [{dx: 3 m}]\n" + error_lines),
            "study.yaml:8:13: axis 'dx' has no value '3 m'; expected one of: 2 m, 1 m, 50 cm; did "
            "you mean '2 m'?");
}

TEST_F(study_file, richardson_needs_an_axis_of_three_numbers) {
  EXPECT_EQ(refusal(two_axes + "error: {against: richardson, columns: [p], axis: integrator}\n"),
            "study.yaml:8:50: error.axis: 'integrator' has no three numbers; expected an axis of "
            "three or more numbers");
}

}  // namespace
}  // namespace perifrac::test
