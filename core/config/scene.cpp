#include "core/config/scene.hpp"

#include <filesystem>
#include <optional>

#include "core/config/mistakes.hpp"
#include "core/config/override.hpp"
#include "core/config/scene_tree.hpp"
#include "core/config/scene_validator.hpp"

namespace perifrac {

Section read_scene(const std::string& path, const std::vector<std::string>& overrides,
                   const Catalogue& catalogue) {
  YamlNode written = parse_yaml_file(path);
  Mistakes mistakes;
  for (const std::string& assignment : overrides) {
    mistakes.note([&] { apply_override(written, assignment); });
  }
  std::optional<Section> scene;
  mistakes.note([&] { scene = check_tree(written, path, catalogue); });
  mistakes.throw_if_any();
  return *scene;
}

Section check_tree(const YamlNode& written, const std::string& path, const Catalogue& catalogue) {
  auto scene = std::make_shared<SceneTree>(SceneTree{.keys = build_key_tree(catalogue)});
  scene->folder = std::filesystem::path(path).parent_path().string();
  validate_scene(written, *scene);
  return {scene, ""};
}

}  // namespace perifrac
