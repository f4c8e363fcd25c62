#pragma once

#include <string>
#include <vector>

#include "core/config/catalogue.hpp"
#include "core/config/section.hpp"
#include "core/config/yaml_tree.hpp"

namespace perifrac {

/// Reads the scene at `path`, puts the `key=value` assignments of `--set` into it and checks all of
/// it against the catalogue. The section returned is the whole scene: `scene.at("solid")`.
/// Throws InputError with a line a mistake, which names `file:line:column` or `--set key=value`.
Section read_scene(const std::string& path, const std::vector<std::string>& overrides,
                   const Catalogue& catalogue);

/// The second half of it: `written` was read from the file at `path`.
Section check_tree(const YamlNode& written, const std::string& path, const Catalogue& catalogue);

}  // namespace perifrac
