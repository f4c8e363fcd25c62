#pragma once

#include <vector>

#include "core/module/module_type.hpp"

namespace perifrac {

/// Every physics module that a scene may name. The one list to add a module to.
const std::vector<ModuleType>& module_types();

/// Physics in the order in which they advance within a window.
const std::vector<std::string>& physics_order();

/// Those that the scene names, in that order.
std::vector<std::string> physics_of(const Section& scene);

}  // namespace perifrac
