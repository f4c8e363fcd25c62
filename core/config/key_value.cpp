#include "core/config/key_value.hpp"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/range.hpp"
#include "core/config/units.hpp"

namespace perifrac {
namespace {

[[noreturn]] void refuse(const YamlNode& node, std::string_view path, std::string_view rest) {
  const std::string& place = node.kind == YamlNode::Kind::null ? node.key_place : node.place;
  throw InputError(fmt::format("{}: {}: {}", place, path, rest));
}

std::string in_range(const Key& key, int dimension) {
  const std::string unit = unit_in(key.unit, dimension);
  return key.range + (unit.empty() ? "" : " " + unit);
}

/// Permeabilities, which alone are areas, are at most some 1e-7 m^2, that of gravel. More without a
/// unit is most likely meant in millidarcies.
constexpr double largest_bare_area = 1e-6;

bool is_implausible(const std::string& unit, double value, const std::string& text) {
  return unit == "m^2" && value > largest_bare_area &&
         text.find_first_not_of("0123456789.eE+- \t") == std::string::npos;
}

double read_number(const Key& key, const YamlNode& node, const std::string& path, int dimension) {
  if (node.kind != YamlNode::Kind::scalar) {
    refuse(node, path,
           fmt::format("{}; expected {}", describe_kind(node),
                       describe_quantity(unit_in(key.unit, dimension))));
  }
  double value = 0.0;
  try {
    value = to_si(node.text, unit_in(key.unit, dimension));
  } catch (const QuantityError& error) {
    refuse(node, path, error.what());
  }
  if (!Range(key.range).holds(value)) {
    refuse(node, path,
           fmt::format("{} is out of range; expected a value in {}", in_quotes(node.text),
                       in_range(key, dimension)));
  }
  if (is_implausible(key.unit, value, node.text)) {
    refuse(node, path,
           fmt::format("{} without a unit is {:g} m^2, more than any rock has; expected a "
                       "permeability with its unit, such as '1 mD' or '1e-15 m^2'",
                       in_quotes(node.text), value));
  }
  return value;
}

int read_integer(const Key& key, const YamlNode& node, const std::string& path) {
  int value = 0;
  const char* last = node.text.data() + node.text.size();
  const auto [end, error] = std::from_chars(node.text.data(), last, value);
  if (error != std::errc{} || end != last) {
    refuse(node, path,
           fmt::format("{} is not a whole number; expected {}", in_quotes(node.text),
                       describe_value(key, 0)));
  }
  if (!Range(key.range).holds(value)) {
    refuse(node, path,
           fmt::format("{} is out of range; expected {}", in_quotes(node.text),
                       describe_value(key, 0)));
  }
  return value;
}

std::vector<double> read_numbers(const Key& key, const YamlNode& node, const std::string& path,
                                 int dimension) {
  const bool is_vector = key.type == KeyType::vector;
  if (is_vector && node.children.size() != static_cast<std::size_t>(dimension)) {
    refuse(node, path,
           fmt::format("has {} components; expected {} in {}D, as in [{}]", node.children.size(),
                       dimension, dimension, dimension == 2 ? "x, y" : "x, y, z"));
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < node.children.size(); ++i) {
    values.push_back(read_number(key, node.children[i], fmt::format("{}[{}]", path, i), dimension));
  }
  return values;
}

}  // namespace

std::string unit_in(const std::string& unit, int dimension) {
  const auto bar = unit.find('|');
  if (bar == std::string::npos) return unit;
  return dimension == 2 ? unit.substr(0, bar) : unit.substr(bar + 1);
}

std::string describe_value(const Key& key, int dimension) {
  const std::string unit = unit_in(key.unit, dimension);
  const std::string range = key.range.empty() ? "" : " in " + in_range(key, dimension);
  switch (key.type) {
    case KeyType::number:
      return key.unit.empty() ? "a number" + range
                              : describe_quantity(unit) + (range.empty() ? "" : "," + range);
    case KeyType::integer:
      return "a whole number" + range;
    case KeyType::boolean:
      return "true or false";
    case KeyType::word:
      return "one of: " + list_names(key.words);
    case KeyType::text:
      return "a text";
    case KeyType::vector:
      return fmt::format("a list of {}, each {}", dimension, describe_quantity(unit) + range);
    case KeyType::numbers:
      return fmt::format("a list, each {}", describe_quantity(unit) + range);
    case KeyType::tree:
      return "a list or a map";
  }
  return {};
}

KeyValue read_value(const Key& key, const YamlNode& node, const std::string& path, int dimension) {
  if (key.type == KeyType::tree) {
    if (node.children.empty())
      refuse(node, path, describe_kind(node) + "; expected a list or a map with something in it");
    return node;
  }
  const bool wants_list = key.type == KeyType::vector || key.type == KeyType::numbers;
  const auto wanted = wants_list ? YamlNode::Kind::list : YamlNode::Kind::scalar;
  if (node.kind != wanted) {
    refuse(node, path,
           fmt::format("{}; expected {}", describe_kind(node), describe_value(key, dimension)));
  }
  switch (key.type) {
    case KeyType::number:
      return read_number(key, node, path, dimension);
    case KeyType::integer:
      return read_integer(key, node, path);
    case KeyType::text:
      return node.text;
    case KeyType::vector:
    case KeyType::numbers:
      return read_numbers(key, node, path, dimension);
    case KeyType::boolean:
      if (node.text != "true" && node.text != "false") {
        refuse(node, path,
               fmt::format("{} is no truth value; expected true or false", in_quotes(node.text)));
      }
      return node.text == "true";
    case KeyType::word:
      if (std::find(key.words.begin(), key.words.end(), node.text) == key.words.end()) {
        refuse(node, path,
               fmt::format("unknown word {}; {}", in_quotes(node.text),
                           expected_one_of(key.words, node.text)));
      }
      return node.text;
    case KeyType::tree:
      break;  // read above
  }
  return {};
}

}  // namespace perifrac
