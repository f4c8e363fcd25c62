#pragma once

#include <string>

#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// Puts one `key=value` of `--set` into a scene: `pore_flow.porosity=0.2`, `probes[0].at=[0 m, 1
/// m]`. Maps on the way are made where they are missing, items of lists are not. Messages about
/// what it puts there are placed at `--set key=value`. Throws InputError.
void apply_override(YamlNode& scene, const std::string& assignment);

/// The same with a value that stands in a file: messages are placed where it stands there.
void set_key(YamlNode& scene, const std::string& path, YamlNode value);

}  // namespace perifrac
