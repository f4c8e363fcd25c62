#include "app/simulation/register_modules.hpp"

#include <algorithm>
#include <iterator>

#include "modules/crack_fluid/network/network_type.hpp"
#include "modules/crack_fluid/uniform_pressure/uniform_pressure_type.hpp"
#include "modules/fluid/fluid_type.hpp"
#include "modules/fluid/semi_lagrangian/semi_lagrangian_method.hpp"
#include "modules/fluid/sph/sph_method.hpp"
#include "modules/pore_flow/darcy_type.hpp"
#include "modules/pore_flow/finite_volume/finite_volume_type.hpp"
#include "modules/solid/solid_types.hpp"

namespace perifrac {

const std::vector<ModuleType>& module_types() {
  static const std::vector<ModuleType> types = {
      quasi_static_solid_type(), dynamic_solid_type(),
      rigid_solid_type(),        darcy_type(),
      finite_volume_type(),      fluid_type<semi_lagrangian_method>(),
      fluid_type<sph_method>(),  crack_network_type(),
      uniform_pressure_type(),
  };
  return types;
}

const std::vector<std::string>& physics_order() {
  static const std::vector<std::string> order = {"fluid", "crack_fluid", "pore_flow", "solid"};
  return order;
}

std::vector<std::string> physics_of(const Section& scene) {
  const std::vector<std::string> written = scene.names("");
  std::vector<std::string> named;
  std::ranges::copy_if(physics_order(), std::back_inserter(named), [&](const std::string& physics) {
    return std::ranges::count(written, physics) > 0;
  });
  return named;
}

}  // namespace perifrac
