#pragma once

#include "core/config/scene_tree.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// Checks a scene as written against the keys of `scene` and fills its entries. Throws InputError
/// for the first thing that is wrong: in every map first the names, then the values, then what is
/// missing.
void validate_scene(const YamlNode& written, SceneTree& scene);

}  // namespace perifrac
