#pragma once

#include <algorithm>

#include "app/simulation/register_modules.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Of the fluid in cracks; 0 of a kind that does not ask for one [Pa s].
inline double crack_viscosity(const Section& scene) {
  const std::string type = scene.word("crack_fluid.type");
  const auto is_asked_for = [](const Key& key) { return key.path == "viscosity" && key.required; };
  const bool has_one = std::ranges::any_of(module_types(), [&](const ModuleType& module) {
    return module.section == "crack_fluid" && module.name == type &&
           std::ranges::any_of(module.keys, is_asked_for);
  });
  return has_one ? scene.number("crack_fluid.viscosity") : 0.0;
}

}  // namespace perifrac
