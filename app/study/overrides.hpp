#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/config/key_tree.hpp"
#include "core/config/section.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// A key of the scene and what a study puts there.
struct Override {
  std::string key;  ///< of the scene; `scene` and `threads` are the run's own
  YamlNode value;

  /// `key=value`, as `--set` takes it.
  std::string assignment() const { return key + "=" + yaml_text(value); }
};

using Overrides = std::vector<Override>;

/// Words of a run that are no keys of its scene.
inline constexpr const char* scene_word = "scene";
inline constexpr const char* threads_word = "threads";

/// The keys of scenes that a study may set.
class SceneKeys {
 public:
  SceneKeys();

  /// A map of keys and values. Throws InputError for a key that no scene has, placed where it
  /// stands and with the nearest one.
  Overrides read(const YamlNode& map) const;

  /// The part of a key that no scene has, and what could stand there.
  struct Unknown {
    std::string name;
    std::vector<std::string> known;
  };
  std::optional<Unknown> unknown(const std::string& key) const;

  /// The value as a number in SI, NaN where the key takes none, and the unit of such numbers.
  double number(const std::string& key, const std::string& text) const;
  std::string unit(const std::string& key) const;

 private:
  const Key* numeric(const std::string& key) const;

  KeyNode tree_;
};

/// `name` as a part of the name of a file: blanks and '^' fall out, other signs become '_'.
std::string file_name_part(const std::string& name);

}  // namespace perifrac
