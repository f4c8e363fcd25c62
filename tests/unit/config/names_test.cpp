#include "core/base/names.hpp"

#include <gtest/gtest.h>

namespace perifrac {
namespace {

const std::vector<std::string> known = {"porosity", "permeability", "type", "biot_coefficient"};

TEST(nearest_name, forgives_typing_slips) {
  EXPECT_EQ(nearest_name("porosty", known), "porosity");
  EXPECT_EQ(nearest_name("permeabiltiy", known), "permeability");
  EXPECT_EQ(nearest_name("tpye", known), "type");
  EXPECT_EQ(nearest_name("Biot_Coefficient", known), "biot_coefficient");
}

TEST(nearest_name, stays_silent_where_nothing_is_near) {
  EXPECT_EQ(nearest_name("viscosity_of_the_fluid", known), "");
  EXPECT_EQ(nearest_name("x", known), "");
  EXPECT_EQ(nearest_name("", known), "");
  EXPECT_EQ(nearest_name(std::string(100000, 'a'), known), "");
}

TEST(expected_one_of, cuts_long_lists) {
  EXPECT_EQ(expected_one_of({"a", "b"}, "zzz"), "expected one of: a, b");
  EXPECT_EQ(expected_one_of({"a", "b", "c", "d", "e", "f", "g", "h", "i"}, "zzz"),
            "expected one of: a, b, c, d, e, f, g, h, ...");
}

TEST(in_quotes, keeps_a_message_on_one_line) {
  EXPECT_EQ(in_quotes("a\nb\x1b"), "'a?b?'");
  EXPECT_EQ(in_quotes(std::string(61, 'x')), "'" + std::string(60, 'x') + "...'");
}

}  // namespace
}  // namespace perifrac
