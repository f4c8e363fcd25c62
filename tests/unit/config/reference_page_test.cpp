#include "core/config/reference_page.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/config/scene_fixture.hpp"

namespace perifrac {
namespace {

using testing::HasSubstr;

TEST(reference_page, shows_every_key_of_every_section_and_type) {
  const std::string page = reference_page(example_catalogue());
  EXPECT_THAT(page, HasSubstr("\n## Top level\n"));
  EXPECT_THAT(page, HasSubstr("\n## `solid` with `type: quasi_static`\n\nEquilibrium"));
  EXPECT_THAT(page, HasSubstr("\n## `solid` with `type: rigid`\n\nNothing moves.\n\nNo further"));
  for (const SectionKeys& entry : example_catalogue()) {
    for (const Key& key : entry.keys) EXPECT_THAT(page, HasSubstr("| `" + key.path + "` |"));
  }
}

TEST(reference_page, has_one_row_a_key_with_all_that_is_declared) {
  const std::string page = reference_page(example_catalogue());
  EXPECT_THAT(page, HasSubstr("| `shape` | `box`, `ball` |  |  | `box` | Shape. |\n"));
  EXPECT_THAT(page, HasSubstr("| `boundary.*.force` | number | `N/m\\|N` |  | required | Force. "
                              "Only where `type=rigid_plate`. |\n"));
}

TEST(list_keys, puts_the_entries_of_a_section_side_by_side) {
  const auto keys =
      list_keys({{"solid", "a", {{.path = "x", .meaning = "."}}},
                 {"flow", "b", {{.path = "y", .meaning = "."}}},
                 {"solid", "c", {{.path = "z", .type = KeyType::vector, .meaning = "."}}}});
  ASSERT_EQ(keys.size(), 3u);
  EXPECT_EQ(keys[1].type, "c");
  EXPECT_EQ(keys[1].kind, "vector");
  EXPECT_EQ(keys[2].section, "flow");
}

}  // namespace
}  // namespace perifrac
