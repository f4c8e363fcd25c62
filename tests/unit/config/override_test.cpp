#include "core/config/override.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

using testing::ElementsAre;

TEST(override, replaces_adds_and_reaches_into_lists) {
  const Section scene =
      read_text(example_scene, {"pore_flow.porosity=0.2", "pore_flow.iterations.max=7",
                                "pore_flow.porosity=0.1", "output.probes[0].at=[1 mm, 2 mm]",
                                "solid.boundary.base={type: roller}", "title=a=b"});
  EXPECT_EQ(scene.number("pore_flow.porosity"), 0.1);
  EXPECT_EQ(scene.integer("pore_flow.iterations.max"), 7);
  EXPECT_THAT(scene.numbers("output.probes[0].at"), ElementsAre(1e-3, 2e-3));
  EXPECT_THAT(scene.names("solid.boundary"), ElementsAre("top", "left", "base"));
  EXPECT_EQ(scene.text("title"), "a=b");
}

TEST(override, mends_what_the_file_has_wrong) {
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity: 3"), {"pore_flow.porosity=0.3"}),
            "accepted");
}

TEST(override, mistakes_are_placed_at_the_option) {
  EXPECT_EQ(refusal(example_scene, {"pore_flow.porosity=1.5"}),
            "--set pore_flow.porosity=1.5: pore_flow.porosity: '1.5' is out of range; "
            "expected a value in [0, 1)");
  EXPECT_EQ(refusal(example_scene, {"pore_flow.porosty=0.5"}),
            "--set pore_flow.porosty=0.5: pore_flow: unknown key 'porosty'; expected one of: type, "
            "porosity, adaptive, iterations, boundary; did you mean 'porosity'?");
  EXPECT_EQ(refusal(example_scene, {"solid.boundary.base={}"}),
            "--set solid.boundary.base={}: solid.boundary.base: missing key 'type'; "
            "expected one of: roller, rigid_plate");
  EXPECT_EQ(
      refusal(example_scene, {"porosity"}),
      "--set porosity: not an assignment; expected key=value, such as pore_flow.porosity=0.2");
  EXPECT_EQ(refusal(example_scene, {"output.probes[2].name=c"}),
            "--set output.probes[2].name=c: no item [2] in 'probes'; expected an item of the 2 "
            "there are");
  EXPECT_EQ(refusal(example_scene, {"output.probes[x].name=c"}),
            "--set output.probes[x].name=c: '[x]' is no place in a list; expected one as in [0]");
  EXPECT_EQ(refusal(example_scene, {"title[0]=c"}),
            "--set title[0]=c: no item [0] in 'title'; expected a list there");
  EXPECT_EQ(refusal(example_scene, {"title.short=c"}),
            "--set title.short=c: 'title' holds no keys; expected a map there");
  EXPECT_EQ(refusal(example_scene, {"body..spacing=1"}),
            "--set body..spacing=1: an empty name in the key; expected names between the dots");
  EXPECT_EQ(
      refusal(example_scene, {"pore_flow.porosity="}),
      "--set pore_flow.porosity=: pore_flow.porosity: has no value; expected a number in [0, 1)");
  EXPECT_THAT(refusal(example_scene, {"body.size=[1, 2"}),
              testing::EndsWith("every bracket closed"));
}

}  // namespace
}  // namespace perifrac
