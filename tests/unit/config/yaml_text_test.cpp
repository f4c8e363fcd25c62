#include <gtest/gtest.h>

#include "core/config/override.hpp"
#include "core/config/yaml_tree.hpp"
#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

bool same(const YamlNode& one, const YamlNode& other) {
  if (one.kind != other.kind || one.text != other.text || one.key != other.key ||
      one.children.size() != other.children.size()) {
    return false;
  }
  for (std::size_t i = 0; i < one.children.size(); ++i) {
    if (!same(one.children[i], other.children[i])) return false;
  }
  return true;
}

TEST(yaml_text, reads_back_as_the_same) {
  for (const char* text :
       {"10 kN/m", "[1 m, -2 mm]", "{type: roller, at: [0, {b: c}]}", "'a: b, [c] #d'", "''", "'~'",
        "'null'", "' blank '", "'- item'", "'say \"so\" \\ once'", "\"two\\nlines\"", "m^2/s"}) {
    const YamlNode read = parse_yaml_text(text, "test");
    const std::string written = yaml_text(read);
    EXPECT_EQ(written.find('\n'), written.npos) << written;
    EXPECT_TRUE(same(read, parse_yaml_text(written, "test"))) << text << " -> " << written;
  }
}

TEST(yaml_text, is_plain_where_that_is_enough) {
  EXPECT_EQ(yaml_text(parse_yaml_text("[ 1 m,  2 m ]", "test")), "[1 m, 2 m]");
  EXPECT_EQ(yaml_text(parse_yaml_text("\"0.5 m\"", "test")), "0.5 m");
}

TEST(set_key, places_messages_where_the_value_stands) {
  YamlNode scene = parse_yaml_text("{body: [1, 2]}", "scene");
  YamlNode value = parse_yaml_text("3", "study.yaml:2:7");
  set_key(scene, "body[1]", value);
  EXPECT_EQ(scene.child("body")->children[1].text, "3");
  EXPECT_EQ(scene.child("body")->children[1].place, "study.yaml:2:7");
  try {
    set_key(scene, "body[7]", value);
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_EQ(std::string(error.what()).substr(0, 15), "study.yaml:2:7:");
  }
}

}  // namespace
}  // namespace perifrac
