#include "core/config/scene.hpp"

#include <filesystem>

#include "core/config/override.hpp"
#include "core/config/scene_tree.hpp"
#include "core/config/scene_validator.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

Section read_scene(const std::string& path, const std::vector<std::string>& overrides,
                   const Catalogue& catalogue) {
  YamlNode written = parse_yaml_file(path);
  for (const std::string& assignment : overrides) apply_override(written, assignment);
  auto scene = std::make_shared<SceneTree>(SceneTree{.keys = build_key_tree(catalogue)});
  scene->folder = std::filesystem::path(path).parent_path().string();
  validate_scene(written, *scene);
  return {scene, ""};
}

}  // namespace perifrac
