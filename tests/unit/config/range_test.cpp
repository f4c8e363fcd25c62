#include "core/config/range.hpp"

#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

TEST(range, brackets_include_and_parentheses_do_not) {
  const Range half_open("[0, 0.5)");
  EXPECT_TRUE(half_open.holds(0.0));
  EXPECT_TRUE(half_open.holds(0.4999));
  EXPECT_FALSE(half_open.holds(0.5));
  EXPECT_FALSE(half_open.holds(-1e-300));
  const Range positive("(0, inf)");
  EXPECT_FALSE(positive.holds(0.0));
  EXPECT_TRUE(positive.holds(std::numeric_limits<double>::max()));
  EXPECT_TRUE(Range("(-inf, -2]").holds(-2.0));
}

TEST(range, no_text_holds_any_number) { EXPECT_TRUE(Range("").holds(-1e300)); }

TEST(range, malformed_ones_are_mistakes_of_ours) {
  for (const char* text :
       {"0, 1", "[0, 1", "[0]", "[1, 0]", "[0; 1]", "[a, b]", "[0,1]", "[", "[]"}) {
    EXPECT_THROW(Range{text}, std::logic_error) << text;
  }
}

}  // namespace
}  // namespace perifrac
