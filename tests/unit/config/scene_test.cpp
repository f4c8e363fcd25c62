#include "core/config/scene.hpp"

#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

TEST(scene, the_example_is_accepted) { EXPECT_EQ(refusal(example_scene), "accepted"); }

TEST(scene, names_the_nearest_key) {
  EXPECT_EQ(refusal(changed("pore_flow:", "porflow:")),
            "{file}:12:1: unknown key 'porflow'; expected one of: title, dimension, body, solid, "
            "pore_flow, output; did you mean 'pore_flow'?");
  EXPECT_EQ(refusal(changed("dimension", "dimensions")),
            "{file}:2:1: unknown key 'dimensions'; expected one of: title, dimension, body, solid, "
            "pore_flow, output; did you mean 'dimension'?");
  EXPECT_EQ(refusal(changed("youngs_modulus", "young_modulus")),
            "{file}:8:14: solid.material: unknown key 'young_modulus'; expected one of: "
            "youngs_modulus, poisson_ratio; did you mean 'youngs_modulus'?");
  EXPECT_EQ(refusal(changed("at: [40", "att: [40")),
            "{file}:21:20: output.probes[1]: unknown key 'att'; expected one of: name, at; "
            "did you mean 'at'?");
}

TEST(scene, names_the_nearest_word) {
  EXPECT_EQ(refusal(changed("quasi_static", "quasistatic")),
            "{file}:7:9: solid.type: unknown word 'quasistatic'; expected one of: quasi_static, "
            "rigid; did you mean 'quasi_static'?");
  EXPECT_EQ(refusal(changed("type: roller", "type: ''")),
            "{file}:11:18: solid.boundary.left.type: unknown word ''; expected one of: roller, "
            "rigid_plate");
}

TEST(scene, duplicate_keys_name_both_lines) {
  EXPECT_EQ(
      refusal(changed("  porosity: 0.3", "  porosity: 0.3\n  porosity: 0.4")),
      "{file}:15:3: duplicate key 'porosity'; expected each key once; it stands on line 14 too");
}

TEST(scene, items_of_a_list_have_names_that_differ) {
  EXPECT_THAT(refusal(changed("edge", "centre")),
              StartsWith("{file}:21:14: output.probes[1].name: a second 'centre'; expected names "
                         "that differ; the first is at "));
}

TEST(scene, missing_keys_point_at_their_parent) {
  EXPECT_EQ(refusal(changed("  porosity: 0.3\n", "")),
            "{file}:12:1: pore_flow: missing key 'porosity'; expected a number in [0, 1)");
  EXPECT_EQ(refusal(changed("  material: {youngs_modulus: 1 GPa}\n", "")),
            "{file}:6:1: solid: missing key 'material.youngs_modulus'; expected a pressure [Pa], "
            "such as '1 MPa', in (0, inf) Pa");
  EXPECT_EQ(refusal(changed("  type: quasi_static\n", "")),
            "{file}:6:1: solid: missing key 'type'; expected one of: quasi_static, rigid");
  EXPECT_EQ(refusal(changed("dimension: 2\n", "")),
            "{file}:1:1: missing key 'dimension'; expected a whole number in [2, 3]");
  EXPECT_EQ(refusal("dimension: 2"),
            "{file}:1:1: missing key 'body.spacing'; expected a length [m], such as '1 mm', in "
            "(0, inf) m\n"
            "{file}:1:1: missing key 'body.size'; expected a list of 2, each a length [m], such as "
            "'1 mm' in (0, inf) m");
  EXPECT_EQ(refusal(changed(", at: [40 cm, 0]", "")),
            "{file}:21:7: output.probes[1]: missing key 'at'; expected a list of 2, each a length "
            "[m], such as '1 mm'");
}

TEST(scene, keys_of_another_choice_are_refused) {
  EXPECT_EQ(refusal(changed("type: quasi_static", "type: rigid")),
            "{file}:8:3: solid: key 'material' is not used where type is 'rigid'; expected one of: "
            "type\n"
            "{file}:9:3: solid: key 'boundary' is not used where type is 'rigid'; expected one of: "
            "type");
  EXPECT_EQ(refusal(changed("{type: roller}", "{force: 3, type: roller}")),
            "{file}:11:12: solid.boundary.left: key 'force' is not used where type is 'roller'; "
            "expected one of: type");
  EXPECT_EQ(refusal(changed("body:\n", "body:\n  radius: 1 m\n")),
            "{file}:4:3: body: key 'radius' is not used where shape is 'box'; expected one of: "
            "shape, size, spacing");
}

TEST(scene, the_choice_decides_unit_and_need) {
  EXPECT_EQ(refusal(changed("value: 1 mm/s", "value: 1 Pa")),
            "{file}:16:32: pore_flow.boundary.right.value: '1 Pa' is a pressure [Pa]; expected a "
            "velocity [m/s], such as '1 mm/s'");
  EXPECT_EQ(refusal(changed("type: flux, value: 1 mm/s", "type: pressure, value: 1 Pa")),
            "accepted");
  EXPECT_EQ(refusal(changed(", force: 10 kN/m", "")),
            "{file}:10:5: solid.boundary.top: missing key 'force'; expected a force per length "
            "[N/m], such as '1 kN/m'");
}

TEST(scene, wrong_kinds_are_named) {
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity: high")),
            "{file}:14:13: pore_flow.porosity: 'high' is not a number; expected a number without a "
            "unit");
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity: [0.3]")),
            "{file}:14:13: pore_flow.porosity: is a list; expected a number in [0, 1)");
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity: {value: 0.3}")),
            "{file}:14:13: pore_flow.porosity: is a map; expected a number in [0, 1)");
  EXPECT_EQ(
      refusal(changed("size: [4 m, 2 m]", "size: 4 m")),
      "{file}:4:9: body.size: '4 m' is a single value; expected a list of 2, each a length [m], "
      "such as '1 mm' in (0, inf) m");
  EXPECT_EQ(refusal(changed("material: {youngs_modulus: 1 GPa}", "material: [1 GPa]")),
            "{file}:8:3: solid.material: is a list; expected keys such as: youngs_modulus, "
            "poisson_ratio");
  EXPECT_EQ(refusal(changed("    left: {type: roller}", "    left: roller")),
            "{file}:11:5: solid.boundary.left: 'roller' is a single value; expected keys such as: "
            "type, force");
  EXPECT_EQ(
      refusal("dimension: two"),
      "{file}:1:12: dimension: 'two' is not a whole number; expected a whole number in [2, 3]");
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity: 0.3\n  adaptive: yes")),
            "{file}:15:13: pore_flow.adaptive: 'yes' is no truth value; expected true or false");
  EXPECT_THAT(refusal("dimension: 2\nbody: {size: [1, 1], spacing: 1}\noutput: {probes: {at: 1}}"),
              StartsWith("{file}:3:10: output.probes: is a map; expected a list of items"));
}

TEST(scene, nothing_where_something_belongs) {
  EXPECT_EQ(refusal(""),
            "{file}:1:1: the scene is empty; expected keys such as: title, dimension, body, solid, "
            "pore_flow, output");
  EXPECT_THAT(refusal("# only a comment\n"), StartsWith("{file}:1:1: the scene is empty"));
  EXPECT_EQ(refusal("dimension: 2\nbody: {size: [1, 1], spacing: 1}\nsolid:\n"),
            "{file}:3:1: solid: has no value; expected keys such as: type");
  EXPECT_EQ(refusal(changed("porosity: 0.3", "porosity:")),
            "{file}:14:3: pore_flow.porosity: has no value; expected a number in [0, 1)");
  EXPECT_THAT(refusal("- 1\n- 2\n"), StartsWith("{file}:1:1: is a list; expected keys such as"));
}

TEST(scene, vectors_have_one_component_a_dimension) {
  EXPECT_EQ(refusal(changed("[40 cm, 0]", "[40 cm, 0, 0]")),
            "{file}:21:24: output.probes[1].at: has 3 components; expected 2 in 2D, as in [x, y]");
  EXPECT_THAT(refusal(changed("dimension: 2", "dimension: 3")),
              StartsWith("{file}:4:9: body.size: has 2 components; expected 3 in 3D"));
}

TEST(scene, numbers_lie_in_their_range) {
  EXPECT_EQ(refusal(changed("spacing: 1 cm", "spacing: -1 cm")),
            "{file}:5:12: body.spacing: '-1 cm' is out of range; expected a value in (0, inf) m");
  EXPECT_EQ(refusal(changed("[4 m, 2 m]", "[4 m, 0 m]")),
            "{file}:4:15: body.size[1]: '0 m' is out of range; expected a value in (0, inf) m");
  EXPECT_EQ(refusal("dimension: 4"),
            "{file}:1:12: dimension: '4' is out of range; expected a whole number in [2, 3]");
  EXPECT_THAT(refusal("dimension: 99999999999"), HasSubstr("is not a whole number"));
}

TEST(scene, bad_yaml_is_one_line_with_its_place) {
  EXPECT_EQ(refusal("dimension: 2\n   body: 3\n"),
            "{file}:2:8: not valid YAML (illegal map value); expected 'key: value', indented by "
            "spaces");
  EXPECT_THAT(refusal("dimension: 2\nbody:\n\tsize: 1\n"), StartsWith("{file}:3:"));
  EXPECT_THAT(refusal("dimension: [2"), HasSubstr("not valid YAML"));
  EXPECT_THAT(refusal(std::string(100000, '[')), StartsWith("{file}:1:"));
  EXPECT_EQ(refusal("dimension: 2\n---\ndimension: 3\n"),
            "{file}:2:1: a second document begins; expected one document a file");
  EXPECT_EQ(refusal("a: &x 1\nb: *x\n"),
            "{file}:2:4: aliases are not read; expected the value itself");
  EXPECT_THAT(refusal("<<: {dimension: 2}\n"), StartsWith("{file}:1:1: unknown key '<<'"));
  EXPECT_EQ(refusal("? [a]\n: 1\n"),
            "{file}:1:3: a list or map stands where a key belongs; expected a name before ':', and "
            "every bracket closed");
  EXPECT_EQ(refusal("~: 1\n"), "{file}:1:1: a key is empty; expected a name before ':'");
}

TEST(scene, names_of_the_users_choice_are_plain) {
  EXPECT_EQ(refusal(changed("left:", "left.top:")),
            "{file}:11:5: solid.boundary: the name 'left.top'; expected letters, digits, '_' and "
            "'-'");
}

TEST(scene, messages_stay_on_one_line) {
  for (const char* text : {"\"a\\nb\": 1", "dimension: \"2\\n3\"", "title: \"a\n"}) {
    std::istringstream lines(refusal(text));
    for (std::string line; std::getline(lines, line);) {
      EXPECT_THAT(line, StartsWith("{file}:1:")) << text;
    }
  }
}

TEST(scene, tells_all_mistakes_at_once) {
  std::string scene = changed("youngs_modulus: 1 GPa", "youngs_modulus: 1 m");
  scene.replace(scene.find("porosity: 0.3"), 13, "porosty: 0.3");
  scene.replace(scene.find("left:"), 5, "lef.t:");
  EXPECT_EQ(refusal(scene),
            "{file}:8:30: solid.material.youngs_modulus: '1 m' is a length [m]; expected a "
            "pressure [Pa], such as '1 MPa'\n"
            "{file}:11:5: solid.boundary: the name 'lef.t'; expected letters, digits, '_' and "
            "'-'\n"
            "{file}:14:3: pore_flow: unknown key 'porosty'; expected one of: type, porosity, "
            "adaptive, iterations, boundary; did you mean 'porosity'?")
      << "a misspelt key is not missing besides";
}

TEST(scene, tells_no_more_mistakes_than_anybody_reads) {
  std::string scene = example_scene;
  for (int k = 0; k < 1000; ++k) scene += "key_" + std::to_string(k) + ": 1\n";
  const std::string said = refusal(scene);
  EXPECT_EQ(std::ranges::count(said, '\n'), 50);
  EXPECT_THAT(said, HasSubstr("only the first 50 mistakes are shown"));
}

TEST(scene, knows_what_others_call_a_key) {
  EXPECT_THAT(refusal(changed("youngs_modulus", "E")), HasSubstr("did you mean 'youngs_modulus'?"));
  EXPECT_THAT(refusal(changed("dimension: 2\n", "dimension: 2\nmesh_size: 1 m\n")),
              HasSubstr("did you mean 'body.spacing'?"));
}

TEST(scene, files_that_cannot_be_read) {
  const auto message = [](const std::string& path) -> std::string {
    try {
      read_scene(path, {}, example_catalogue());
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  };
  EXPECT_EQ(
      message("no_such_scene.yaml"),
      "no_such_scene.yaml: cannot be read (No such file or directory); expected a scene file");
  EXPECT_EQ(message("/"), "/: cannot be read (Is a directory); expected a scene file");
}

TEST(scene, a_default_that_its_key_refuses_is_a_mistake_of_ours) {
  const SceneFile file("dimension: 2\n");
  const Catalogue catalogue = {
      {"",
       "",
       {{.path = "dimension", .type = KeyType::integer, .meaning = "."},
        {.path = "spacing", .unit = "m", .range = "(0, inf)", .fallback = "0 m", .meaning = "."}}}};
  EXPECT_THROW(read_scene(file.path(), {}, catalogue), std::logic_error);
}

}  // namespace
}  // namespace perifrac
