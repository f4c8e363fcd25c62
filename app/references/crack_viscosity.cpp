#include "app/references/crack_viscosity.hpp"

#include <algorithm>

#include "app/simulation/register_modules.hpp"

namespace perifrac {

double crack_viscosity(const Section& scene) {
  const std::string type = scene.word("crack_fluid.type");
  for (const ModuleType& module : module_types()) {
    if (module.section != "crack_fluid" || module.name != type) continue;
    const bool is_asked_for = std::ranges::any_of(
        module.keys, [](const Key& key) { return key.path == "viscosity" && key.required; });
    if (is_asked_for) return scene.number("crack_fluid.viscosity");
  }
  return 0.0;
}

}  // namespace perifrac
