#include "core/config/units.hpp"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

using testing::HasSubstr;

std::string refusal(std::string_view text, std::string_view unit) {
  try {
    const double value = to_si(text, unit);
    return "accepted as " + std::to_string(value);
  } catch (const QuantityError& error) {
    return error.what();
  }
}

struct Quantity {
  const char* text;
  const char* unit;
  double si;
};

class Accepted : public testing::TestWithParam<Quantity> {};

TEST_P(Accepted, reads_into_si) {
  const auto& [text, unit, si] = GetParam();
  EXPECT_NEAR(to_si(text, unit), si, 4e-16 * std::abs(si)) << text;
}

INSTANTIATE_TEST_SUITE_P(
    units, Accepted,
    testing::Values(
        Quantity{"0.21 MPa", "Pa", 0.21e6}, Quantity{"400MPa", "Pa", 4e8},
        Quantity{"12.5", "Pa", 12.5}, Quantity{" -3e-2  m ", "m", -0.03},
        Quantity{"+2 mm", "m", 2e-3}, Quantity{".5 m", "m", 0.5},
        Quantity{"0.16 mm^2/ms", "m^2/s", 0.16e-3}, Quantity{"1.02e-9 mm^2", "m^2", 1.02e-15},
        Quantity{"5 J/m^2", "J/m^2", 5.0}, Quantity{"5 N/m", "J/m^2", 5.0},
        Quantity{"1 cP", "Pa*s", 1e-3}, Quantity{"1 cP", "Pa s", 1e-3},
        Quantity{"2 mPa s", "Pa s", 2e-3}, Quantity{"10 mD", "m^2", 9.869233e-15},
        Quantity{"1 D", "m^2", 9.869233e-13}, Quantity{"1 mD/cP", "m^2/Pa/s", 9.869233e-13},
        Quantity{"1000 kg/m^3", "kg/m^3", 1000.0}, Quantity{"1000 kg m-3", "kg/m^3", 1000.0},
        Quantity{"1 g/cm3", "kg/m^3", 1e3}, Quantity{"4e-10 1/Pa", "1/Pa", 4e-10},
        Quantity{"4 1/GPa", "1/Pa", 4e-9}, Quantity{"30 %", "", 0.3}, Quantity{"0.3", "", 0.3},
        Quantity{"5 µm", "m", 5e-6}, Quantity{"2 m²", "m^2", 2.0},
        Quantity{"3 MPa*sqrt(m)", "Pa*sqrt(m)", 3e6}, Quantity{"3 MPa sqrt(m)", "Pa*sqrt(m)", 3e6},
        Quantity{"3 mm/s*sqrt(s)", "m/s*sqrt(s)", 3e-3},
        Quantity{"3 Pa*sqrt(m)", "Pa*sqrt(m)", 3.0}, Quantity{"300 K", "K", 300.0},
        Quantity{"1 day", "s", 86400.0}));

TEST(units, name_what_was_found_and_what_would_do) {
  EXPECT_EQ(refusal("1 Pa", "m"),
            "'1 Pa' is a pressure [Pa]; expected a length [m], such as '1 mm'");
  EXPECT_EQ(refusal("3 m", "Pa s"),
            "'3 m' is a length [m]; expected a viscosity [Pa s], such as '1 cP'");
  EXPECT_EQ(refusal("2 mm", ""), "'2 mm' is a length [m]; expected a number without a unit");
  EXPECT_THAT(refusal("2 km*kg", "m"), HasSubstr("is a quantity in [m.kg]"));
  EXPECT_THAT(refusal("1 foo", "m"), HasSubstr("has the unknown unit 'foo'"));
}

TEST(units, refuse_reciprocals) {
  EXPECT_THAT(refusal("5 Hz", "s"), HasSubstr("is a rate [1/s]; expected a time"));
  EXPECT_THAT(refusal("5 1/m", "m"), HasSubstr("; expected a length"));
}

TEST(units, refuse_roots_that_only_one_side_has) {
  EXPECT_THAT(refusal("3 MPa*sqrt(m)", "Pa"), HasSubstr("is a fracture toughness"));
  EXPECT_THAT(refusal("3 MPa", "Pa*sqrt(m)"), HasSubstr("is a pressure"));
  EXPECT_THAT(refusal("3 m/s*sqrt(m)", "m/s*sqrt(s)"), HasSubstr("sqrt(m)"));
}

TEST(units, refuse_decimal_exponents) {
  for (const char* text : {"3 MPa m^0.5", "3 m1.5", "3 m^1.5", "3 MPa*m^.5", "3 m^-0.5"}) {
    EXPECT_THAT(refusal(text, "Pa*sqrt(m)"), HasSubstr("decimal exponent")) << text;
  }
}

TEST(units, refuse_what_is_no_finite_decimal_number) {
  for (const char* text : {"nan", "inf", "-inf", "infinity", ".inf", "-.inf", ".nan", "inf Pa"}) {
    EXPECT_THAT(refusal(text, "Pa"), HasSubstr("is not finite")) << text;
  }
  EXPECT_THAT(refusal("1e999", "Pa"), HasSubstr("too large or too small"));
  EXPECT_THAT(refusal("1e308 MPa", "Pa"), HasSubstr("too large"));
  EXPECT_THAT(refusal("0x10", "Pa"), HasSubstr("hexadecimal"));
  EXPECT_THAT(refusal("-0x10", "Pa"), HasSubstr("hexadecimal"));
  for (const char* text : {"", "abc", "1.2.3", "1,5", "1_000", "2/3", "--1", "+-1", "MPa"}) {
    EXPECT_THAT(refusal(text, "Pa"), HasSubstr("is not a number")) << text;
  }
}

TEST(units, refuse_further_numbers) {
  EXPECT_THAT(refusal("1 2 Pa", "Pa"), HasSubstr("holds two numbers"));
  for (const char* text : {"1 MPa 3", "1 MPa/2", "1 m^1/2", "1 kg*(2)", "1 m -3", "3 1/2"}) {
    EXPECT_THAT(refusal(text, "Pa"), HasSubstr("second number")) << text;
  }
}

TEST(units, refuse_other_zeros_logarithms_and_dates) {
  EXPECT_THAT(refusal("20 degC", "K"), HasSubstr("counts from another zero than K"));
  EXPECT_THAT(refusal("20 °C", "K"), HasSubstr("counts from another zero than K"));
  for (const char* text : {"5 s @ 3", "5 s since 1970-01-01", "5 lg(re 1 Pa)", "5 Pa; rm"}) {
    EXPECT_THAT(refusal(text, "s"), HasSubstr("; expected")) << text;
  }
}

TEST(units, refuse_are_or_year) {
  for (const char* text : {"1 a", "1 Ma", "1 m^2/a", "1 a*m"}) {
    EXPECT_THAT(refusal(text, "s"), HasSubstr("may be an are or a year")) << text;
  }
  EXPECT_DOUBLE_EQ(to_si("1 year", "s"), 31556925.9747);
}

TEST(units, a_key_with_an_unknown_unit_is_a_mistake_of_ours) {
  EXPECT_THROW(to_si("1 m", "foo"), std::logic_error);
}

}  // namespace
}  // namespace perifrac
