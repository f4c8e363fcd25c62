#include "app/writing/json_schema.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/run/scene_keys.hpp"
#include "core/config/key_tree.hpp"
#include "core/config/range.hpp"

namespace perifrac {

namespace {

using Json = nlohmann::ordered_json;

/// A decimal number and perhaps a unit; neither hexadecimal nor with a decimal exponent.
constexpr const char* magnitude_pattern =
    R"((?!0[xX])([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?(?![0-9.,]|[eE][-+]?[0-9.])\s*([^\s0-9.,].*|1/.*)?$)";

/// Bounds hold for bare numbers, the pattern for those with a unit. One schema of both: of two,
/// editors show neither's meaning.
Json number_schema(const Key& key) {
  Json schema = {{"type", "integer"}};
  const Range range(key.range);
  if (std::isfinite(range.lowest())) {
    schema[range.includes_lowest() ? "minimum" : "exclusiveMinimum"] = range.lowest();
  }
  if (std::isfinite(range.highest())) {
    schema[range.includes_highest() ? "maximum" : "exclusiveMaximum"] = range.highest();
  }
  if (key.type == KeyType::integer) return schema;
  schema["type"] = {"number", "string"};
  const std::string sign = range.lowest() >= 0.0 ? "[+]?" : "[-+]?";
  schema["pattern"] = "^\\s*" + sign + magnitude_pattern;
  return schema;
}

/// What the key may hold.
Json values_schema(const Key& key) {
  switch (key.type) {
    case KeyType::number:
    case KeyType::integer:
      return number_schema(key);
    case KeyType::boolean:
      return {{"type", "boolean"}};
    case KeyType::word:
      return {{"enum", key.words}};
    case KeyType::text:
      return {{"type", {"string", "number", "boolean"}}};
    case KeyType::vector:
      return {{"type", "array"}, {"items", number_schema(key)}, {"minItems", 2}, {"maxItems", 3}};
    case KeyType::numbers:
      return {{"type", "array"}, {"items", number_schema(key)}};
    case KeyType::tree:
      return {{"type", {"array", "object"}}, {"minItems", 1}, {"minProperties", 1}};
  }
  return {};
}

std::string description(const Key& key) {
  std::string text = key.meaning;
  if (!key.unit.empty()) text += fmt::format(" Unit: {}.", key.unit);
  if (!key.range.empty()) text += fmt::format(" Range: {}.", key.range);
  if (!key.fallback.empty()) text += fmt::format(" Default: {}.", key.fallback);
  if (!key.when.empty()) text += fmt::format(" Only where {}.", key.when);
  return text;
}

Json leaf_schema(const Key& key) {
  Json schema = {{"description", description(key)}};
  schema.update(values_schema(key));
  if (key.fallback.empty()) return schema;
  const Json fallback = Json::parse(key.fallback, nullptr, false);
  schema["default"] = fallback.is_discarded() ? Json(key.fallback) : fallback;
  return schema;
}

/// All that a map of the tree may hold in a section of one type.
class MapSchema {
 public:
  MapSchema(const KeyNode& map, std::string type) : map_(map), type_(std::move(type)) {}

  Json write() {
    if (map_.takes_any_name()) {
      return {{"type", "object"},
              {"propertyNames", {{"pattern", "^[A-Za-z0-9_-]+$"}}},
              {"additionalProperties", node_schema(map_.children.front())}};
    }
    for (const KeyNode& child : map_.children) {
      if (child.declarations.empty()) {
        add_group(child);
      } else {
        add_leaf(child);
      }
    }
    Json schema = {
        {"type", "object"}, {"properties", properties_}, {"additionalProperties", false}};
    if (!required_.empty()) schema["required"] = required_;
    if (!conditions_.empty()) schema["allOf"] = conditions_;
    return schema;
  }

  /// The map has to be written, for keys without which it is not whole.
  bool is_needed() const {
    if (map_.takes_any_name() || map_.is_list()) return false;
    return std::ranges::any_of(map_.children, [&](const KeyNode& child) {
      if (child.declarations.empty()) return MapSchema(child, type_).is_needed();
      const auto held = declared(child);
      const auto first =
          std::ranges::find_if(held, [&](const Key* key) { return holds_by_default(*key); });
      return first != held.end() && (*first)->required;
    });
  }

 private:
  std::vector<const Key*> declared(const KeyNode& leaf) const {
    std::vector<const Key*> keys;
    for (const auto& [key, type] : leaf.declarations) {
      if (type.empty() || type == type_) keys.push_back(&key);
    }
    return keys;
  }

  /// The words of a condition are there where nothing is written.
  bool is_default(const KeyCondition& condition) const {
    const KeyNode* choice = map_.child(condition.name);
    return choice != nullptr && std::ranges::any_of(declared(*choice), [&](const Key* key) {
             return std::ranges::find(condition.words, key->fallback) != condition.words.end();
           });
  }

  bool holds_by_default(const Key& key) const {
    return key.when.empty() || is_default(parse_condition(key.when));
  }

  Json holds(const Key& key) const {
    const KeyCondition condition = parse_condition(key.when);
    Json schema = {{"properties", {{condition.name, {{"enum", condition.words}}}}}};
    if (!is_default(condition)) schema["required"] = Json::array({condition.name});
    return schema;
  }

  Json node_schema(const KeyNode& node) const {
    if (!node.declarations.empty()) return leaf_schema(*declared(node).front());
    if (!node.is_list()) return MapSchema(node, type_).write();
    return {{"type", "array"}, {"items", node_schema(node.children.front())}};
  }

  void add_group(const KeyNode& child) {
    if (!child.holds_under(type_)) return;
    properties_[child.name] = node_schema(child);
    if (MapSchema(child, type_).is_needed()) required_.push_back(child.name);
  }

  void add_leaf(const KeyNode& child) {
    const std::vector<const Key*> keys = declared(child);
    if (keys.empty()) return;
    if (keys.front()->when.empty()) {
      properties_[child.name] = leaf_schema(*keys.front());
      if (keys.front()->required) required_.push_back(child.name);
      return;
    }
    properties_[child.name] = {{"description", description(*keys.front())}};
    Json otherwise = {{"properties", {{child.name, false}}}};
    for (auto key = keys.rbegin(); key != keys.rend(); ++key) {
      Json then = {{"properties", {{child.name, leaf_schema(**key)}}}};
      if ((*key)->required) then["required"] = Json::array({child.name});
      if ((*key)->when.empty()) {
        otherwise = then;
      } else {
        otherwise = {{"if", holds(**key)}, {"then", then}, {"else", otherwise}};
      }
    }
    conditions_.push_back(otherwise);
  }

  const KeyNode& map_;
  std::string type_;
  Json properties_ = Json::object();
  Json required_ = Json::array();
  Json conditions_ = Json::array();
};

bool differs_by_type(const KeyNode& node) {
  return std::ranges::any_of(node.declarations,
                             [](const auto& declaration) { return !declaration.type.empty(); }) ||
         std::ranges::any_of(node.children, differs_by_type);
}

/// A section whose word `type` picks what else it holds: first the word, then its keys.
Json section_schema(const KeyNode& section) {
  if (!section.has_types() || !differs_by_type(section)) return MapSchema(section, "").write();
  const Key& choice = section.child("type")->declarations.front().key;
  Json cases = Json::array();
  for (const std::string& word : choice.words) {
    cases.push_back(
        {{"if",
          {{"properties", {{"type", {{"const", word}}}}}, {"required", Json::array({"type"})}}},
         {"then", MapSchema(section, word).write()}});
  }
  return {{"type", "object"},
          {"properties", {{"type", leaf_schema(choice)}}},
          {"required", Json::array({"type"})},
          {"allOf", cases}};
}

/// A section that is off where the file leaves it out.
bool may_be_left_out(const KeyNode& section) { return section.optional || section.has_types(); }

}  // namespace

nlohmann::ordered_json json_schema(const Catalogue& catalogue) {
  const KeyNode tree = build_key_tree(catalogue);
  Json schema = MapSchema(tree, "").write();
  Json required = Json::array();
  for (const KeyNode& child : tree.children) {
    if (!child.declarations.empty()) {
      if (child.declarations.front().key.required) required.push_back(child.name);
      continue;
    }
    if (child.is_list()) continue;
    schema["properties"][child.name] = section_schema(child);
    if (!may_be_left_out(child) && MapSchema(child, "").is_needed()) {
      required.push_back(child.name);
    }
  }
  for (const SectionKeys& entry : catalogue) {
    if (!entry.meaning.empty() && entry.type.empty()) {
      schema["properties"][entry.section]["description"] = entry.meaning;
    }
  }
  schema["required"] = required;
  Json head = {{"$schema", "http://json-schema.org/draft-07/schema#"},
               {"title", "Scene of perifrac"}};
  head.update(schema);
  return head;
}

std::string json_schema_of_scenes() { return json_schema(scene_catalogue()).dump(1) + "\n"; }

}  // namespace perifrac
