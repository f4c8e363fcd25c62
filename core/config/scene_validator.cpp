#include "core/config/scene_validator.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include <fmt/format.h>

#include "core/base/names.hpp"
#include "core/config/key_suggestion.hpp"
#include "core/config/mistakes.hpp"

namespace perifrac {
namespace {

[[noreturn]] void refuse(const std::string& place, const std::string& path,
                         std::string_view problem, std::string_view expected) {
  throw InputError(
      fmt::format("{}: {}{}{}; {}", place, path, path.empty() ? "" : ": ", problem, expected));
}

/// Names of the user's choice become parts of paths.
bool is_plain_name(const std::string& name) {
  return !name.empty() && name.find_first_not_of(
                              "abcdefghijklmnopqrstuvwxyz"
                              "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-") == std::string::npos;
}

/// A map of the scene and what may stand in it. `written` is null where it was left out; `place`
/// is then that of the nearest parent that was not.
struct Map {
  const YamlNode* written;
  const KeyNode& keys;
  std::string path;
  std::string place;
  std::string type;  ///< of the section it lies in
};

class Validator {
 public:
  explicit Validator(SceneTree& scene) : scene_(scene) {}

  void validate(const YamlNode& written) {
    const Map root{&written, scene_.keys, "", written.place, ""};
    require_map(written, scene_.keys, "", "");
    check_names(root);
    const KeyNode* dimension = scene_.keys.child("dimension");
    if (dimension != nullptr) {
      note(root, *dimension);  // units and lengths of vectors follow it
      if (!scene_.entries.contains("dimension")) mistakes_.throw_if_any();
      dimension_ = std::get<int>(scene_.entries.at("dimension").value);
    }
    read_map(root);
    mistakes_.throw_if_any();
  }

 private:
  /// What is wrong with one child keeps nobody from looking at the next.
  void note(const Map& map, const KeyNode& keys) {
    if (!mistakes_.note([&] { read_child(map, keys); })) {
      broken_.insert(join_path(map.path, keys.name));
    }
  }

  void read_map(const Map& map) {
    SceneTree::Entry entry{.place = map.written != nullptr ? map.place : ""};
    if (map.written != nullptr) {
      check_names(map);
      for (const YamlNode& child : map.written->children) entry.children.push_back(child.key);
      scene_.entries[map.path] = std::move(entry);
    }
    if (map.keys.takes_any_name()) {
      if (map.written == nullptr) return;
      for (const YamlNode& child : map.written->children) {
        mistakes_.note([&] { read_named(map, child); });
      }
      return;
    }
    // Words that decide which other keys hold come before them.
    for (const bool conditional : {false, true}) {
      for (const KeyNode* child : in_order(map)) {
        if (child->is_conditional() == conditional) note(map, *child);
      }
    }
  }

  /// Written children in the file's order, then the others.
  static std::vector<const KeyNode*> in_order(const Map& map) {
    std::vector<const KeyNode*> ordered;
    if (map.written != nullptr) {
      for (const YamlNode& child : map.written->children) {
        const KeyNode* known = map.keys.child(child.key);
        if (known != nullptr) ordered.push_back(known);
      }
    }
    for (const KeyNode& child : map.keys.children) {
      if (std::find(ordered.begin(), ordered.end(), &child) == ordered.end()) {
        ordered.push_back(&child);
      }
    }
    return ordered;
  }

  void read_named(const Map& map, const YamlNode& written) {
    if (!is_plain_name(written.key)) {
      refuse(written.key_place, map.path, fmt::format("the name {}", in_quotes(written.key)),
             "expected letters, digits, '_' and '-'");
    }
    read_node(map, map.keys.children.front(), &written, join_path(map.path, written.key));
  }

  void read_child(const Map& map, const KeyNode& keys) {
    const YamlNode* written = map.written != nullptr ? map.written->child(keys.name) : nullptr;
    read_node(map, keys, written, join_path(map.path, keys.name));
  }

  void read_node(const Map& map, const KeyNode& keys, const YamlNode* written,
                 const std::string& path) {
    if (keys.declarations.empty()) {
      read_group(map, keys, written, path);
    } else {
      read_leaf(map, keys, written, path);
    }
  }

  /// A map or a list of them.
  void read_group(const Map& parent, const KeyNode& keys, const YamlNode* written,
                  const std::string& path) {
    const bool is_section = parent.path.empty();
    std::string type = parent.type;
    if (written != nullptr && !is_section && !keys.holds_under(type)) {
      refuse_unused(parent, *written, "type", type);
    }
    if (keys.is_list()) {
      if (written != nullptr) read_list(parent, keys, *written, path);
      return;
    }
    if (written != nullptr) require_map(*written, keys, path, type);
    if (is_section && written == nullptr && (keys.optional || keys.has_types())) {
      return;  // what the scene does not call for
    }
    if (is_section && keys.has_types()) {
      type = section_type(keys, *written, path);
      if (type.empty()) return;  // nobody knows which keys hold
    } else if (written == nullptr && !keys.holds_under(type)) {
      return;
    }
    read_map({written, keys, path, written != nullptr ? written->key_place : parent.place, type});
  }

  /// The word at `type` of a section that has one.
  std::string section_type(const KeyNode& keys, const YamlNode& written, const std::string& path) {
    const Map section{&written, keys, path, written.key_place, ""};
    scene_.entries[path].place = written.key_place;
    const KeyNode& choice = *keys.child("type");
    const bool is_given = written.child("type") != nullptr;
    if (!is_given || !mistakes_.note([&] { read_child(section, choice); })) check_names(section);
    if (!is_given) read_child(section, choice);
    if (!scene_.entries.contains(join_path(path, "type"))) return {};
    return std::get<std::string>(scene_.entries.at(join_path(path, "type")).value);
  }

  void read_list(const Map& parent, const KeyNode& keys, const YamlNode& written,
                 const std::string& path) {
    if (written.kind != YamlNode::Kind::list) {
      refuse(written.key_place, path, describe_kind(written),
             "expected a list of items, each '- key: value'");
    }
    SceneTree::Entry entry{.place = written.key_place};
    std::unordered_map<std::string_view, const YamlNode*> names;
    for (std::size_t i = 0; i < written.children.size(); ++i) {
      const YamlNode& item = written.children[i];
      entry.children.push_back(fmt::format("[{}]", i));
      const std::string item_path = join_path(path, entry.children.back());
      mistakes_.note([&] {
        require_map(item, keys.children.front(), item_path, parent.type);
        read_map({&item, keys.children.front(), item_path, item.place, parent.type});
        const YamlNode* name = item.child("name");
        if (name == nullptr) return;
        const auto [first, is_new] = names.try_emplace(name->text, name);
        if (!is_new) refuse_second_name(*name, *first->second, item_path);
      });
    }
    scene_.entries[path] = std::move(entry);
  }

  [[noreturn]] static void refuse_second_name(const YamlNode& name, const YamlNode& first,
                                              const std::string& item_path) {
    refuse(name.place, join_path(item_path, "name"),
           fmt::format("a second {}", in_quotes(name.text)),
           fmt::format("expected names that differ; the first is at {}", first.place));
  }

  void read_leaf(const Map& map, const KeyNode& keys, const YamlNode* written,
                 const std::string& path) {
    const Key* key = active_key(map, keys);
    if (written == nullptr) {
      if (key != nullptr) read_default(map, *key, keys.name, path);
      return;
    }
    if (key == nullptr) {
      const auto [name, word] = why_not(map, keys);
      if (broken_.contains(join_path(map.path, name))) return;  // nobody knows whether it holds
      refuse_unused(map, *written, name, word);
    }
    scene_.entries[path] = {read_value(*key, *written, path, dimension_), written->place, {}};
  }

  void read_default(const Map& map, const Key& key, const std::string& name,
                    const std::string& path) {
    if (!key.fallback.empty()) {
      scene_.entries[path] = {default_value(key, path), "", {}};
      return;
    }
    if (!key.required || misspelt_.contains(path)) return;
    // Parents that were left out too belong to what is missing.
    std::string missing = name;
    std::string parent = map.path;
    while (!scene_.entries.contains(parent) && !parent.empty()) {
      const auto dot = parent.rfind('.');
      missing = parent.substr(dot == std::string::npos ? 0 : dot + 1) + "." + missing;
      parent = dot == std::string::npos ? "" : parent.substr(0, dot);
    }
    refuse(map.place, parent, fmt::format("missing key '{}'", missing),
           "expected " + describe_value(key, dimension_));
  }

  KeyValue default_value(const Key& key, const std::string& path) const {
    try {
      if (key.type == KeyType::text || key.type == KeyType::word) {
        return read_value(key, {.kind = YamlNode::Kind::scalar, .text = key.fallback}, path,
                          dimension_);
      }
      return read_value(key, parse_yaml_text(key.fallback, "default"), path, dimension_);
    } catch (const InputError& error) {
      throw std::logic_error(error.what());
    }
  }

  const Key* active_key(const Map& map, const KeyNode& node) const {
    for (const auto& [key, type] : node.declarations) {
      if ((type.empty() || type == map.type) && condition_holds(map, key)) return &key;
    }
    return nullptr;
  }

  bool condition_holds(const Map& map, const Key& key) const {
    if (key.when.empty()) return true;
    const KeyCondition condition = parse_condition(key.when);
    const std::string word = word_at(map, condition.name);
    return std::find(condition.words.begin(), condition.words.end(), word) != condition.words.end();
  }

  std::string word_at(const Map& map, const std::string& name) const {
    const auto entry = scene_.entries.find(join_path(map.path, name));
    return entry == scene_.entries.end() ? "" : std::get<std::string>(entry->second.value);
  }

  /// The key, and its word, that keep another from holding: the section's type or Key::when.
  std::pair<std::string, std::string> why_not(const Map& map, const KeyNode& node) const {
    for (const auto& [key, type] : node.declarations) {
      if (!type.empty() && type != map.type) continue;
      const std::string name = parse_condition(key.when).name;
      return {name, word_at(map, name)};
    }
    return {"type", map.type};
  }

  [[noreturn]] void refuse_unused(const Map& map, const YamlNode& written, const std::string& name,
                                  const std::string& word) const {
    std::vector<std::string> holding;
    for (const KeyNode& child : map.keys.children) {
      if (child.declarations.empty() ? child.holds_under(map.type)
                                     : active_key(map, child) != nullptr) {
        holding.push_back(child.name);
      }
    }
    refuse(written.key_place, map.path,
           fmt::format("key {} is not used where {} is '{}'", in_quotes(written.key), name, word),
           expected_one_of(holding, written.key));
  }

  void check_names(const Map& map) {
    if (map.keys.takes_any_name()) return;
    for (const YamlNode& child : map.written->children) {
      const bool known = std::ranges::any_of(
          map.keys.children, [&](const KeyNode& key) { return key.name == child.key; });
      if (known) continue;
      const std::vector<std::string> names = declared_names(map);
      misspelt_.insert(join_path(map.path, near_key(child.key, names)));
      mistakes_.note([&] {
        refuse(child.key_place, map.path, fmt::format("unknown key {}", in_quotes(child.key)),
               expected_key(child.key, names, scene_.keys));
      });
    }
  }

  /// The names that may stand in a map before it is known which conditions hold.
  static std::vector<std::string> declared_names(const Map& map) {
    std::vector<std::string> found;
    for (const KeyNode& child : map.keys.children) {
      if (child.holds_under(map.type)) found.push_back(child.name);
    }
    return found;
  }

  void require_map(const YamlNode& written, const KeyNode& keys, const std::string& path,
                   const std::string& type) const {
    if (written.kind == YamlNode::Kind::map) return;
    const bool empty_scene = path.empty() && written.kind == YamlNode::Kind::null;
    const Map map{nullptr, keys, path, "", type};
    refuse(written.key_place, path, empty_scene ? "the scene is empty" : describe_kind(written),
           keys.takes_any_name() ? "expected names of your choice, each with its keys"
                                 : "expected keys such as: " + list_names(declared_names(map)));
  }

  SceneTree& scene_;
  int dimension_ = 0;
  Mistakes mistakes_;
  std::set<std::string> broken_;    ///< paths of what could not be read
  std::set<std::string> misspelt_;  ///< paths of what somebody most likely meant to write
};

}  // namespace

void validate_scene(const YamlNode& written, SceneTree& scene) {
  Validator(scene).validate(written);
}

}  // namespace perifrac
