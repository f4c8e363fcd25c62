#include "core/config/key_tree.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::ElementsAre;

TEST(path_segments, split_names_and_places_in_lists) {
  EXPECT_THAT(path_segments("a.b[0].c"), ElementsAre("a", "b", "[0]", "c"));
  EXPECT_THAT(path_segments("probes[].at"), ElementsAre("probes", "[]", "at"));
  EXPECT_THAT(path_segments("a..b"), ElementsAre("a", "", "b"));
}

TEST(key_tree, finds_concrete_paths) {
  const KeyNode tree =
      build_key_tree({{"solid", "rigid", {{.path = "boundary.*.force", .meaning = "."}}},
                      {"output", "", {{.path = "probes[].at", .meaning = "."}}}});
  EXPECT_NE(tree.find("solid.boundary.left.force"), nullptr);
  EXPECT_NE(tree.find("output.probes[7].at"), nullptr);
  EXPECT_NE(tree.find("solid.type"), nullptr);
  EXPECT_NE(tree.find(""), nullptr);
  EXPECT_EQ(tree.find("solid.boundary.left.farce"), nullptr);
  EXPECT_EQ(tree.find("output.probes.at"), nullptr);
}

TEST(key_tree, contradictions_are_mistakes_of_ours) {
  EXPECT_THROW(
      build_key_tree({{"", "", {{.path = "a", .meaning = "."}, {.path = "a.b", .meaning = "."}}}}),
      std::logic_error);
  EXPECT_THROW(build_key_tree(
                   {{"", "", {{.path = "a.*", .meaning = "."}, {.path = "a.b", .meaning = "."}}}}),
               std::logic_error);
  EXPECT_THROW(
      build_key_tree(
          {{"", "", {{.path = "a.b", .meaning = "."}, {.path = "a[].b", .meaning = "."}}}}),
      std::logic_error);
}

TEST(parse_condition, splits_words) {
  const KeyCondition condition = parse_condition("type=pressure|flux");
  EXPECT_EQ(condition.name, "type");
  EXPECT_THAT(condition.words, ElementsAre("pressure", "flux"));
  EXPECT_THROW(parse_condition("type"), std::logic_error);
}

}  // namespace
}  // namespace perifrac
