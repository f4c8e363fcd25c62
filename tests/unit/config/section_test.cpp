#include "core/config/section.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;

TEST(section, gives_si_values) {
  const Section scene = read_text(example_scene);
  EXPECT_EQ(scene.text("title"), "Example");
  EXPECT_EQ(scene.integer("dimension"), 2);
  EXPECT_EQ(scene.number("body.spacing"), 0.01);
  EXPECT_THAT(scene.at("body").numbers("size"), ElementsAre(4.0, 2.0));
  EXPECT_EQ(scene.at("solid").number("material.youngs_modulus"), 1e9);
  EXPECT_EQ(scene.at("solid").at("boundary.top").number("force"), 1e4);
  EXPECT_EQ(scene.number("pore_flow.boundary.right.value"), 1e-3);
  EXPECT_THAT(scene.numbers("output.times"), ElementsAre(1.0, 60.0));
  EXPECT_THAT(scene.numbers("output.probes[1].at"), ElementsAre(0.4, 0.0));
}

TEST(section, fills_in_defaults_also_where_the_parent_is_absent) {
  const Section scene = read_text(example_scene);
  EXPECT_EQ(scene.word("body.shape"), "box");
  EXPECT_EQ(scene.number("solid.material.poisson_ratio"), 0.25);
  EXPECT_TRUE(scene.boolean("pore_flow.adaptive"));
  EXPECT_EQ(scene.integer("pore_flow.iterations.max"), 3);
  EXPECT_FALSE(scene.has("pore_flow.iterations"));
}

TEST(section, lists_children_in_the_order_of_the_file) {
  const Section scene = read_text(example_scene);
  EXPECT_THAT(scene.names("solid.boundary"), ElementsAre("top", "left"));
  EXPECT_EQ(scene.count("output.probes"), 2u);
  EXPECT_TRUE(scene.has("solid.boundary"));
  const Section rigid =
      read_text("dimension: 2\nbody: {size: [1, 1], spacing: 1}\nsolid: {type: rigid}");
  EXPECT_TRUE(rigid.names("solid.boundary").empty());
  EXPECT_EQ(rigid.count("output.probes"), 0u);
  EXPECT_FALSE(rigid.has("pore_flow"));
  EXPECT_FALSE(rigid.has("pore_flow.porosity"));
}

TEST(section, units_and_lengths_follow_the_dimension) {
  const std::string scene =
      "body: {size: [1, 1, 1], spacing: 1}\n"
      "solid:\n  type: quasi_static\n  material: {youngs_modulus: 1}\n"
      "  boundary: {top: {type: rigid_plate, force: 2 kN}}\ndimension: 3\n";
  EXPECT_EQ(read_text(scene).number("solid.boundary.top.force"), 2e3);
}

TEST(section, undeclared_paths_and_other_types_are_mistakes_of_ours) {
  const Section scene = read_text(example_scene);
  EXPECT_THROW(scene.has("body.spacings"), std::logic_error);
  EXPECT_THROW(scene.number("solid.lame"), std::logic_error);
  EXPECT_THROW(scene.at("solids"), std::logic_error);
  EXPECT_THROW(scene.integer("body.spacing"), std::logic_error);
  EXPECT_THROW(scene.number("body"), std::logic_error);
  EXPECT_THROW(scene.number("body.radius"), std::logic_error);  // declared, but left out
}

std::string failure(const Section& section, const char* path) {
  try {
    section.fail(path, "does not fit", "something else");
  } catch (const InputError& error) {
    const std::string line = error.what();
    return line.substr(line.find(".yaml:") + 6);
  }
}

TEST(section, failures_name_the_place_or_that_of_the_parent) {
  const Section scene = read_text(example_scene);
  EXPECT_EQ(failure(scene.at("body"), "spacing"),
            "5:12: body.spacing: does not fit; expected something else");
  EXPECT_EQ(failure(scene, "solid.boundary.left"),
            "11:5: solid.boundary.left: does not fit; expected something else");
  EXPECT_EQ(failure(scene.at("pore_flow"), "iterations.max"),
            "12:1: pore_flow.iterations.max: does not fit; expected something else");
  EXPECT_EQ(failure(scene, "output.probes[1]"),
            "21:7: output.probes[1]: does not fit; expected something else");
}

TEST(section, failures_about_names_suggest_the_nearest) {
  const Section scene = read_text(example_scene);
  try {
    scene.fail_unknown("solid.boundary.top", "top", {"bottom", "left", "tip"});
    FAIL();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), testing::EndsWith("10:5: solid.boundary.top: unknown name 'top'; "
                                                "expected one of: bottom, left, tip; "
                                                "did you mean 'tip'?"));
  }
}

}  // namespace
}  // namespace perifrac
