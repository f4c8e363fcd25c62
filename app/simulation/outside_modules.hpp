#pragma once

#include <string>
#include <vector>

#include "core/module/module_type.hpp"
#include "modules/solid/material/material_type.hpp"

namespace perifrac {

/// Add to what scenes may name. Where a module's physics is new, that advances after all others.
void add_module_type(ModuleType type);
void add_material(MaterialType type);
/// How often that has happened.
std::size_t added_types();

/// From now on scenes may name libraries: --allow-modules. Their code does what the user may do.
void allow_outside_modules();
bool outside_modules_are_allowed();

/// Loads the libraries that the scene at `path` names under `modules`, its --set assignments
/// included, and adds what they hold to what scenes may name, once a process. Before the catalogue
/// is asked for. Throws InputError, placed at the library's name.
void load_outside_modules(const std::string& path, const std::vector<std::string>& overrides = {});

}  // namespace perifrac
