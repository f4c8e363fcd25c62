#include "app/writing/explain.hpp"

#include <algorithm>
#include <filesystem>
#include <set>
#include <tuple>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/installation/data_folder.hpp"
#include "app/run/scene_keys.hpp"
#include "core/base/errors.hpp"
#include "core/base/names.hpp"
#include "core/config/key_suggestion.hpp"
#include "core/config/key_tree.hpp"
#include "core/config/reference_page.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

namespace {

using Segments = std::vector<std::string>;

/// More than these are not listed one by one.
constexpr std::size_t most_scenes = 8, most_suggestions = 6;

struct ListedKey {
  KeyReference key;
  std::string path;  ///< from the top level
  Segments segments;
  std::vector<std::string> types;  ///< of its section, under which it holds; empty: under all
};

/// Keys of other types of a section that mean the same are one.
bool says_the_same(const ListedKey& one, const ListedKey& other) {
  const auto about = [](const KeyReference& key) {
    return std::tie(key.meaning, key.kind, key.words, key.unit, key.range, key.fallback,
                    key.required, key.when);
  };
  return one.path == other.path && about(one.key) == about(other.key);
}

std::vector<ListedKey> all_keys() {
  std::vector<ListedKey> keys;
  for (const KeyReference& key : list_keys(scene_catalogue())) {
    const std::string path = join_path(key.section, key.path);
    ListedKey listed{key, path, path_segments(path), {}};
    if (!key.type.empty()) listed.types.push_back(key.type);
    const auto same = std::ranges::find_if(
        keys, [&](const ListedKey& other) { return says_the_same(listed, other); });
    if (same == keys.end()) {
      keys.push_back(std::move(listed));
    } else {
      same->types.push_back(key.type);
    }
  }
  return keys;
}

/// `[3]` stands for `[]`.
Segments normalised(Segments written) {
  for (std::string& segment : written) {
    if (segment.starts_with('[')) segment = "[]";
  }
  return written;
}

/// A name of one's own stands for `*`.
bool begins(const Segments& key, const Segments& written) {
  return written.size() <= key.size() &&
         std::equal(written.begin(), written.end(), key.begin(),
                    [](const auto& a, const auto& b) { return a == b || (b == "*" && a != "[]"); });
}

bool ends(const Segments& key, const Segments& written) {
  return written.size() <= key.size() && std::equal(written.rbegin(), written.rend(), key.rbegin());
}

/// The groups within keys whose last name is the one written, as crack_fluid.inlets of `inlets`;
/// each once.
std::vector<Segments> groups_named(const Segments& written, const std::vector<ListedKey>& keys) {
  std::vector<Segments> groups;
  for (const ListedKey& listed : keys) {
    for (std::size_t length = 1; length < listed.segments.size(); ++length) {
      Segments group(listed.segments.begin(), listed.segments.begin() + std::ptrdiff_t(length));
      if (ends(group, written) && std::ranges::find(groups, group) == groups.end()) {
        groups.push_back(std::move(group));
      }
    }
  }
  return groups;
}

/// A scene, or a part of it, writes the key.
bool writes(const YamlNode& node, std::span<const std::string> segments) {
  if (segments.empty()) return true;
  return std::ranges::any_of(node.children, [&](const YamlNode& child) {
    const bool is_item = node.kind == YamlNode::Kind::list && segments[0] == "[]";
    return (is_item || segments[0] == "*" || segments[0] == child.key) &&
           writes(child, segments.subspan(1));
  });
}

bool has_type(const YamlNode& scene, const ListedKey& listed) {
  if (listed.types.empty()) return true;
  const YamlNode* section = scene.child(listed.key.section);
  const YamlNode* type = section != nullptr ? section->child("type") : nullptr;
  return type != nullptr && std::ranges::count(listed.types, type->text) > 0;
}

using Scenes = std::vector<std::pair<std::string, YamlNode>>;

/// Those that come with the program, by name; none where they are not at hand.
Scenes shipped_scenes() {
  Scenes scenes;
  std::error_code ignored;
  for (const auto& entry :
       std::filesystem::directory_iterator(data_folder() / "configs", ignored)) {
    if (entry.path().extension() != ".yaml") continue;
    scenes.emplace_back(entry.path().stem(), parse_yaml_file(entry.path()));
  }
  std::ranges::sort(scenes, {}, &Scenes::value_type::first);
  return scenes;
}

std::string used_in(const ListedKey& listed, const Scenes& scenes) {
  std::vector<std::string> names;
  for (const auto& [name, scene] : scenes) {
    if (has_type(scene, listed) && writes(scene, listed.segments)) names.push_back(name);
  }
  const std::size_t shown = std::min(names.size(), most_scenes);
  std::string text = fmt::format("{}", fmt::join(names.begin(), names.begin() + shown, ", "));
  if (names.size() > shown) text += fmt::format(" and {} more", names.size() - shown);
  return text;
}

void print_line(const char* name, const std::string& text) {
  if (!text.empty()) fmt::print("  {:<9} {}\n", name, text);
}

void print(const ListedKey& listed, const Scenes& scenes) {
  const KeyReference& key = listed.key;
  fmt::print("{}\n  {}\n", listed.path, key.meaning);
  print_line("value", key.words.empty() ? key.kind : "");
  print_line("choices", fmt::format("{}", fmt::join(key.words, ", ")));
  print_line("unit", key.unit.find('|') == std::string::npos
                         ? key.unit
                         : fmt::format("{} in 2D, {} in 3D", key.unit.substr(0, key.unit.find('|')),
                                       key.unit.substr(key.unit.find('|') + 1)));
  print_line("range", key.range);
  print_line("default", key.required ? "none, it must be written" : key.fallback);
  print_line("holds", listed.types.empty()
                          ? ""
                          : fmt::format("{}.type={}", key.section, fmt::join(listed.types, "|")));
  print_line("only with", key.when);
  print_line("used by", used_in(listed, scenes));
}

/// What is declared in a section or a group: names and the first sentence of each.
void print_group(const std::vector<ListedKey>& keys, const Segments& group) {
  for (const SectionKeys& entry : scene_catalogue()) {
    if (group.size() != 1 || entry.section != group[0] || entry.meaning.empty()) continue;
    fmt::print("{}{}\n  {}\n", entry.section, entry.type.empty() ? "" : ": " + entry.type,
               entry.meaning);
  }
  std::set<std::string> seen;
  for (const ListedKey& listed : keys) {
    if (!begins(listed.segments, group) || !seen.insert(listed.path).second) continue;
    const std::string& meaning = listed.key.meaning;
    fmt::print("  {}: {}\n", listed.path, meaning.substr(0, meaning.find(". ")));
  }
}

[[noreturn]] void refuse(const std::string& written, const std::vector<ListedKey>& keys) {
  std::vector<std::string> names, paths;
  for (const ListedKey& listed : keys) {
    for (const std::string& segment : listed.segments) {
      if (segment != "*" && segment != "[]") names.push_back(segment);
    }
  }
  const Segments segments = path_segments(written);
  const auto last = std::ranges::find_if(segments.rbegin(), segments.rend(),
                                         [](const auto& s) { return !s.starts_with('['); });
  const std::string near = last == segments.rend() ? "" : near_key(*last, names);
  for (const ListedKey& listed : keys) {
    if (near.empty() || std::ranges::find(listed.segments, near) == listed.segments.end()) continue;
    if (std::ranges::find(paths, listed.path) == paths.end()) paths.push_back(listed.path);
  }
  const std::size_t shown = std::min(paths.size(), most_suggestions);
  throw InputError(fmt::format(
      "perifrac explain: unknown key {}; expected a key of `perifrac list`{}{}{}",
      in_quotes(written), shown > 0 ? "; did you mean " : "",
      fmt::join(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(shown), ", "),
      shown > 0 ? "?" : ""));
}

}  // namespace

int explain(const std::string& written) {
  const std::vector<ListedKey> keys = all_keys();
  const Segments segments = normalised(path_segments(written));
  std::vector<ListedKey> exact, ending;
  bool is_group = false;
  for (const ListedKey& listed : keys) {
    const bool is_longer = listed.segments.size() > segments.size();
    const bool is_begun = begins(listed.segments, segments);
    if (is_begun && is_longer) is_group = true;
    if (is_begun && !is_longer) exact.push_back(listed);
    if (ends(listed.segments, segments)) ending.push_back(listed);
  }
  if (exact.empty() && is_group) {
    print_group(keys, segments);
    return 0;
  }
  if (exact.empty() && ending.empty() && !written.empty()) {
    const std::vector<Segments> groups = groups_named(segments, keys);
    for (const Segments& group : groups) print_group(keys, group);
    if (!groups.empty()) return 0;
  }
  const std::vector<ListedKey>& found = exact.empty() ? ending : exact;
  if (found.empty() || written.empty()) refuse(written, keys);
  const Scenes scenes = shipped_scenes();
  for (const ListedKey& listed : found) print(listed, scenes);
  return 0;
}

}  // namespace perifrac
