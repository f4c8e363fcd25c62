#pragma once

#include "core/config/scene_tree.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// Checks a scene as written against the keys of `scene` and fills its entries. Throws InputError
/// with a line for every thing that is wrong with its names and values, or missing.
void validate_scene(const YamlNode& written, SceneTree& scene);

}  // namespace perifrac
