#include "app/study/overrides.hpp"

#include <cctype>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/run/scene_keys.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/key_value.hpp"
#include "core/config/units.hpp"

namespace perifrac {

SceneKeys::SceneKeys() : tree_(build_key_tree(scene_catalogue())) {}

Overrides SceneKeys::read(const YamlNode& map) const {
  if (map.kind != YamlNode::Kind::map) {
    throw InputError(fmt::format("{}: {}; expected a map of keys of the scene, such as {}",
                                 map.place, describe_kind(map), "{body.spacing: 1 m}"));
  }
  Overrides result;
  for (const YamlNode& child : map.children) {
    if (const auto wrong = unknown(child.key)) {
      throw InputError(fmt::format("{}: unknown key {} of the scene; {}", child.key_place,
                                   in_quotes(wrong->name),
                                   expected_one_of(wrong->known, wrong->name)));
    }
    result.push_back({child.key, child});
  }
  return result;
}

std::optional<SceneKeys::Unknown> SceneKeys::unknown(const std::string& key) const {
  if (key == scene_word || key == threads_word) return {};
  const KeyNode* node = &tree_;
  for (const std::string& segment : path_segments(key)) {
    const KeyNode* const next = node->child(segment);
    if (next == nullptr) {
      Unknown result{segment, {}};
      for (const KeyNode& child : node->children) result.known.push_back(child.name);
      if (node == &tree_) result.known.insert(result.known.end(), {scene_word, threads_word});
      return result;
    }
    node = next;
  }
  return {};
}

const Key* SceneKeys::numeric(const std::string& key) const {
  static const Key threads{.path = threads_word, .type = KeyType::integer, .meaning = ""};
  if (key == threads_word) return &threads;
  const KeyNode* const node = tree_.find(key);
  if (node == nullptr || node->declarations.empty()) return nullptr;
  const Key& declared = node->declarations.front().key;
  const bool number = declared.type == KeyType::number || declared.type == KeyType::integer;
  return number ? &declared : nullptr;
}

double SceneKeys::number(const std::string& key, const std::string& text) const {
  if (const Key* const declared = numeric(key)) {
    for (const int dimension : {2, 3}) {
      try {
        return to_si(text, unit_in(declared->unit, dimension));
      } catch (const QuantityError&) {  // of the other dimension, or no quantity: the run says so
      }
    }
  }
  return std::numeric_limits<double>::quiet_NaN();
}

std::string SceneKeys::unit(const std::string& key) const {
  const Key* const declared = numeric(key);
  return declared == nullptr ? "" : unit_in(declared->unit, 2);
}

std::string file_name_part(const std::string& name) {
  std::string part;
  for (const char c : name) {
    if (c == ' ' || c == '^') continue;
    const bool kept =
        std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '_' || c == '+';
    part += kept ? c : '_';
  }
  return part;
}

}  // namespace perifrac
