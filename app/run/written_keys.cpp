#include "app/run/written_keys.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/run/scene_keys.hpp"
#include "core/config/key_tree.hpp"

namespace perifrac {

namespace {

bool holds(const Section& scene, const Key& key, const std::string& parent) {
  if (key.when.empty()) return true;
  const KeyCondition condition = parse_condition(key.when);
  const std::string deciding = join_path(parent, condition.name);
  return scene.has(deciding) && std::ranges::count(condition.words, scene.word(deciding)) > 0;
}

void visit_below(const Section& scene, const KeyNode& node, const std::string& path,
                 const KeyVisit& visit) {
  for (const std::string& name : scene.names(path)) {
    const KeyNode* const child = node.child(name);
    const std::string below = join_path(path, name);
    if (child->declarations.empty()) visit_below(scene, *child, below, visit);
    for (const auto& [key, type] : child->declarations) {
      const bool of_type =
          type.empty() || type == scene.word(below.substr(0, below.find('.')) + ".type");
      if (!of_type || !holds(scene, key, path)) continue;
      visit(below, key);
      break;
    }
  }
}

nlohmann::json value_of(const Section& scene, const Key& key, const std::string& path) {
  switch (key.type) {
    case KeyType::number:
      return scene.number(path);
    case KeyType::integer:
      return scene.integer(path);
    case KeyType::boolean:
      return scene.boolean(path);
    case KeyType::word:
      return scene.word(path);
    case KeyType::text:
      return scene.text(path);
    default:
      return scene.numbers(path);
  }
}

nlohmann::json& place_of(nlohmann::json& root, const std::string& path) {
  nlohmann::json* at = &root;
  for (const std::string& segment : path_segments(path)) {
    if (segment.front() == '[') {
      at = &(*at)[std::stoul(segment.substr(1))];
    } else {
      at = &(*at)[segment];
    }
  }
  return *at;
}

}  // namespace

void for_each_written(const Section& scene, const std::string& path, const KeyVisit& visit) {
  static const KeyNode keys = build_key_tree(scene_catalogue());
  visit_below(scene, path.empty() ? keys : *keys.find(path), path, visit);
}

nlohmann::json written_in_si(const Section& scene) {
  nlohmann::json written = nlohmann::json::object();
  for_each_written(scene, "", [&](const std::string& path, const Key& key) {
    if (key.type != KeyType::tree) place_of(written, path) = value_of(scene, key, path);
  });
  return written;
}

}  // namespace perifrac
