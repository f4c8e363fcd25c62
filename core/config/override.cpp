#include "core/config/override.hpp"

#include <charconv>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/key_tree.hpp"

namespace perifrac {
namespace {

[[noreturn]] void refuse(const std::string& place, std::string_view problem,
                         std::string_view expected) {
  throw InputError(fmt::format("{}: {}; expected {}", place, problem, expected));
}

YamlNode& item(YamlNode& list, const std::string& segment, const std::string& place) {
  std::size_t index = 0;
  const char* last = segment.data() + segment.size() - 1;
  const auto [end, error] = std::from_chars(segment.data() + 1, last, index);
  if (error != std::errc{} || end != last) {
    refuse(place, fmt::format("{} is no place in a list", in_quotes(segment)), "one as in [0]");
  }
  if (list.kind != YamlNode::Kind::list || index >= list.children.size()) {
    refuse(place, fmt::format("no item {} in {}", segment, in_quotes(list.key)),
           list.kind == YamlNode::Kind::list
               ? fmt::format("an item of the {} there are", list.children.size())
               : "a list there");
  }
  return list.children[index];
}

YamlNode& member(YamlNode& map, const std::string& segment, const std::string& place) {
  if (map.kind == YamlNode::Kind::null) map.kind = YamlNode::Kind::map;
  if (map.kind != YamlNode::Kind::map) {
    refuse(place, fmt::format("{} holds no keys", in_quotes(map.key)), "a map there");
  }
  for (YamlNode& child : map.children) {
    if (child.key == segment) return child;
  }
  map.children.push_back({.place = place, .key = segment, .key_place = place});
  return map.children.back();
}

}  // namespace

void set_key(YamlNode& scene, const std::string& path, YamlNode value) {
  const std::string place = value.key_place;
  YamlNode* node = &scene;
  for (const std::string& segment : path_segments(path)) {
    if (segment.empty()) refuse(place, "an empty name in the key", "names between the dots");
    node = segment[0] == '[' ? &item(*node, segment, place) : &member(*node, segment, place);
  }
  value.key = node->key;
  *node = std::move(value);
}

void apply_override(YamlNode& scene, const std::string& assignment) {
  const std::string place = "--set " + printable(assignment);
  const auto equals = assignment.find('=');
  if (equals == std::string::npos || equals == 0) {
    refuse(place, "not an assignment", "key=value, such as pore_flow.porosity=0.2");
  }
  YamlNode value = parse_yaml_text(assignment.substr(equals + 1), place);
  value.key_place = place;
  set_key(scene, assignment.substr(0, equals), std::move(value));
}

}  // namespace perifrac
