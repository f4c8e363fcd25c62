#include "core/config/units.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <memory>

#include <fmt/format.h>
#include <udunits2.h>

#include "core/base/names.hpp"

namespace perifrac {
namespace {

struct NamedQuantity {
  std::string_view unit;
  std::string_view name;
  std::string_view example;
};

/// For messages only. Of two with the same dimension the first names what a user wrote.
constexpr std::array named_quantities{
    NamedQuantity{"", "a number without a unit", ""},
    NamedQuantity{"m", "a length", "1 mm"},
    NamedQuantity{"s", "a time", "1 ms"},
    NamedQuantity{"Pa", "a pressure", "1 MPa"},
    NamedQuantity{"m^2", "an area or permeability", "10 mD"},
    NamedQuantity{"Pa*s", "a viscosity", "1 cP"},
    NamedQuantity{"kg/m^3", "a density", "1 g/cm^3"},
    NamedQuantity{"N", "a force", "1 kN"},
    NamedQuantity{"N/m", "a force per length", "1 kN/m"},
    NamedQuantity{"J/m^2", "an energy per area", "5 J/m^2"},
    NamedQuantity{"N/m^3", "a force per volume", "1 kN/m^3"},
    NamedQuantity{"1/Pa", "a compressibility", "1 1/GPa"},
    NamedQuantity{"1/s", "a rate", "1 1/ms"},
    NamedQuantity{"m/s", "a velocity", "1 mm/s"},
    NamedQuantity{"m/s^2", "an acceleration", "9.81 m/s^2"},
    NamedQuantity{"m^2/s", "a diffusivity or flow per thickness", "1 mm^2/ms"},
    NamedQuantity{"m^3", "a volume", "1 l"},
    NamedQuantity{"m^3/s", "a flow rate", "1 l/s"},
    NamedQuantity{"kg", "a mass", "1 g"},
    NamedQuantity{"kg/s", "a mass rate", "1 g/s"},
    NamedQuantity{"kg/m^2/s", "a mass flux", "1 g/m^2/s"},
    NamedQuantity{"J", "an energy", "1 kJ"},
    NamedQuantity{"W", "a power", "1 kW"},
    NamedQuantity{"K", "a temperature", "300 K"},
    NamedQuantity{"Pa*sqrt(m)", "a fracture toughness", "1 MPa*sqrt(m)"},
    NamedQuantity{"m/s*sqrt(s)", "a leak-off coefficient", "1e-5 m/s*sqrt(s)"},
};

constexpr std::array<std::string_view, 2> roots = {"sqrt(m)", "sqrt(s)"};

struct Release {
  void operator()(ut_system* system) const { ut_free_system(system); }
  void operator()(ut_unit* unit) const { ut_free(unit); }
  void operator()(cv_converter* converter) const { cv_free(converter); }
};
using Unit = std::unique_ptr<ut_unit, Release>;
using Converter = std::unique_ptr<cv_converter, Release>;

void add_symbol(ut_system* system, const char* symbol, const char* definition) {
  const Unit unit(ut_parse(system, definition, UT_UTF8));
  ut_map_symbol_to_unit(symbol, UT_UTF8, unit.get());
}

ut_system* unit_system() {
  static const std::unique_ptr<ut_system, Release> system = [] {
    ut_set_error_message_handler(ut_ignore);
    std::unique_ptr<ut_system, Release> loaded(ut_read_xml(nullptr));
    if (!loaded) throw std::runtime_error("the unit database of udunits2 cannot be read");
    // udunits knows neither; its prefixes then give mD and cP.
    add_symbol(loaded.get(), "D", "9.869233e-13 m^2");
    add_symbol(loaded.get(), "P", "0.1 Pa s");
    return loaded;
  }();
  return system.get();
}

/// A unit, and which of `*sqrt(m)` and `*sqrt(s)` follows it, if any: udunits has no roots.
struct RootedUnit {
  Unit unit;
  std::string_view root{};
};

/// `unit` is null if udunits cannot read the text.
RootedUnit parse_unit(std::string_view text) {
  std::string_view found;
  for (const std::string_view root : roots) {
    if (text.size() <= root.size() || !text.ends_with(root)) continue;
    found = root;
    text.remove_suffix(root.size());
    const auto last = text.find_last_not_of(" *.");
    text = text.substr(0, last == std::string_view::npos ? 0 : last + 1);
    break;
  }
  const std::string plain(text.empty() ? "1" : text);
  return {Unit(ut_parse(unit_system(), plain.c_str(), UT_UTF8)), found};
}

/// Factor from one unit to another of the same dimension; nan if the dimensions differ.
/// ut_are_convertible will not do: it takes reciprocals for the same.
double conversion_factor(const RootedUnit& from, const RootedUnit& to) {
  if (from.root != to.root) return std::nan("");
  const Unit one(ut_get_dimensionless_unit_one(unit_system()));
  const Unit ratio(ut_divide(from.unit.get(), to.unit.get()));
  if (!ratio || !ut_is_dimensionless(ratio.get())) return std::nan("");
  const Converter converter(ut_get_converter(ratio.get(), one.get()));
  return converter ? cv_convert_double(converter.get(), 1.0) : std::nan("");
}

bool counts_from_another_zero(const RootedUnit& from, const RootedUnit& to) {
  const Converter converter(ut_get_converter(from.unit.get(), to.unit.get()));
  return converter && cv_convert_double(converter.get(), 0.0) != 0.0;
}

/// `a pressure [Pa]`, or the base units where the quantity has no name here.
std::string describe_found(const RootedUnit& found) {
  for (const NamedQuantity& named : named_quantities) {
    if (std::isfinite(conversion_factor(found, parse_unit(named.unit)))) {
      return named.unit.empty() ? std::string(named.name)
                                : fmt::format("{} [{}]", named.name, named.unit);
    }
  }
  std::array<char, 200> buffer{};
  ut_format(found.unit.get(), buffer.data(), buffer.size() - 1, UT_ASCII | UT_DEFINITION);
  std::string_view base(buffer.data());
  // A unit with a scale is written `1000 m.s-1`; the dimension is what is asked for.
  if (const auto space = base.find(' '); space != std::string_view::npos && base[0] <= '9') {
    base.remove_prefix(space + 1);
  }
  return fmt::format("a quantity in [{}{}{}]", base, found.root.empty() ? "" : ".", found.root);
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return std::isalpha(static_cast<unsigned char>(c)) || (c & 0x80) != 0; }

/// Of the number that begins at `i` of a unit; empty where it may stand there.
std::string misread_number(std::string_view unit, std::size_t i) {
  std::size_t before = i;
  if (before > 1 && (unit[before - 1] == '-' || unit[before - 1] == '+')) --before;
  const bool is_decimal = before > 1 && unit[before - 1] == '.' &&
                          (is_digit(unit[before - 2]) || unit[before - 2] == '^');
  if (is_decimal) {
    return "has a decimal exponent in its unit; expected whole exponents, or 'MPa*sqrt(m)'";
  }
  if (before == 0 || (!is_letter(unit[before - 1]) && unit[before - 1] != '^')) {
    return "has a second number in its unit; expected one number and one unit, as in '5 kg/m^3'";
  }
  return {};
}

/// Prefixed, 'Ma' and its like mean years in geology and ares in udunits.
std::string misread_year(std::string_view unit) {
  for (std::size_t i = 0; i < unit.size();) {
    std::size_t end = i;
    while (end < unit.size() && is_letter(unit[end])) ++end;
    const std::string_view name = unit.substr(i, end - i);
    if (name == "a" || name == "ka" || name == "Ma" || name == "Ga") {
      return fmt::format(
          "has the unit '{}', which may be an are or a year; "
          "expected 'm^2' or 'year' in its place",
          name);
    }
    i = std::max(end, i + 1);
  }
  return {};
}

/// What udunits would silently misread in a unit; empty if nothing.
std::string misreading(std::string_view unit) {
  if (unit.find("**") != unit.npos) return "has '**' in its unit; expected powers as in 'm^2'";
  const bool inverse = unit.starts_with("1/") || unit.starts_with("1 /");
  for (std::size_t i = inverse ? 1 : 0; i < unit.size(); ++i) {
    const char c = unit[i];
    if (!is_letter(c) && !is_digit(c) && std::string_view("^*/.-+() %").find(c) == unit.npos) {
      return fmt::format("has {} in its unit; expected a unit such as 'kg/m^3'",
                         in_quotes(unit.substr(i, 1)));
    }
    if (!is_digit(c) || (i > 0 && is_digit(unit[i - 1]))) continue;
    if (std::string wrong = misread_number(unit, i); !wrong.empty()) return wrong;
  }
  return misread_year(unit);
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

[[noreturn]] void refuse(std::string_view text, std::string_view problem, std::string_view unit) {
  throw QuantityError(
      fmt::format("{} {}; expected {}", in_quotes(text), problem, describe_quantity(unit)));
}

/// Takes the number off the front of `rest`.
double read_number(std::string_view text, std::string_view unit, std::string_view& rest) {
  rest = text;
  if (rest.size() > 1 && rest[0] == '+' && rest[1] != '-') rest.remove_prefix(1);
  const std::string_view digits = rest.starts_with('-') ? rest.substr(1) : rest;
  if (digits.starts_with("0x") || digits.starts_with("0X")) {
    refuse(text, "is a hexadecimal number", unit);
  }
  double number = 0.0;
  const auto [end, error] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (error == std::errc::result_out_of_range) {
    refuse(text, "is too large or too small to be held", unit);
  }
  const bool spelt_out = digits.starts_with(".inf") || digits.starts_with(".Inf") ||
                         digits.starts_with(".INF") || digits.starts_with(".nan") ||
                         digits.starts_with(".NaN") || digits.starts_with(".NAN");
  if (spelt_out || (error == std::errc{} && !std::isfinite(number))) {
    refuse(text, "is not finite", unit);
  }
  if (error != std::errc{}) refuse(text, "is not a number", unit);
  rest.remove_prefix(static_cast<std::size_t>(end - rest.data()));
  return number;
}

}  // namespace

std::string describe_quantity(std::string_view unit) {
  if (unit.empty()) return "a number without a unit";
  // By its text first: J/m^2 and N/m are the same unit for different things.
  auto named = std::find_if(named_quantities.begin(), named_quantities.end(),
                            [&](const NamedQuantity& known) { return known.unit == unit; });
  if (named == named_quantities.end()) {
    const RootedUnit wanted = parse_unit(unit);
    named = std::find_if(named_quantities.begin(), named_quantities.end(),
                         [&](const NamedQuantity& known) {
                           return conversion_factor(wanted, parse_unit(known.unit)) == 1.0;
                         });
  }
  if (named == named_quantities.end()) {
    return fmt::format("a quantity in [{0}], such as '1 {0}'", unit);
  }
  return fmt::format("{} [{}], such as '{}'", named->name, unit, named->example);
}

double to_si(std::string_view text, std::string_view unit) {
  const std::string_view whole = trimmed(text);
  std::string_view rest;
  const double number = read_number(whole, unit, rest);
  const std::string_view written = trimmed(rest);
  if (written.empty()) return number;
  const bool inverse = written.starts_with("1/") || written.starts_with("1 /");
  const bool attached = rest.front() != ' ' && rest.front() != '\t';
  if (!is_letter(written[0]) && written[0] != '%' && (attached || !inverse)) {
    refuse(whole, is_digit(written[0]) ? "holds two numbers" : "is not a number", unit);
  }
  if (const std::string problem = misreading(written); !problem.empty()) {
    throw QuantityError(fmt::format("{} {}", in_quotes(whole), problem));
  }
  const RootedUnit found = parse_unit(written);
  if (!found.unit) refuse(whole, fmt::format("has the unknown unit {}", in_quotes(written)), unit);
  const RootedUnit wanted = parse_unit(unit);
  if (!wanted.unit) throw std::logic_error(fmt::format("no unit '{}' to convert to", unit));
  const double factor = conversion_factor(found, wanted);
  if (std::isnan(factor)) refuse(whole, "is " + describe_found(found), unit);
  if (counts_from_another_zero(found, wanted)) {
    refuse(whole, fmt::format("counts from another zero than {}", unit), unit);
  }
  const double value = number * factor;
  if (!std::isfinite(value)) refuse(whole, "is too large to be held", unit);
  return value;
}

}  // namespace perifrac
