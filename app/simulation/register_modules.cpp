#include "app/simulation/register_modules.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include <fmt/format.h>

#include "app/simulation/outside_modules.hpp"
#include "modules/crack_fluid/network/network_type.hpp"
#include "modules/crack_fluid/uniform_pressure/uniform_pressure_type.hpp"
#include "modules/fluid/fluid_type.hpp"
#include "modules/fluid/semi_lagrangian/semi_lagrangian_method.hpp"
#include "modules/fluid/sph/sph_method.hpp"
#include "modules/pore_flow/darcy_type.hpp"
#include "modules/pore_flow/finite_volume/finite_volume_type.hpp"
#include "modules/solid/solid_types.hpp"

namespace perifrac {

namespace {

std::vector<ModuleType>& all_types() {
  static std::vector<ModuleType> types = {
      quasi_static_solid_type(), dynamic_solid_type(),
      rigid_solid_type(),        darcy_type(),
      finite_volume_type(),      fluid_type<semi_lagrangian_method>(),
      fluid_type<sph_method>(),  crack_network_type(),
      uniform_pressure_type(),
  };
  return types;
}

std::vector<std::string>& whole_order() {
  static std::vector<std::string> order = {"fluid", "crack_fluid", "pore_flow", "solid"};
  return order;
}

std::size_t added = 0;

}  // namespace

const std::vector<ModuleType>& module_types() { return all_types(); }

const std::vector<std::string>& physics_order() { return whole_order(); }

void add_module_type(ModuleType type) {
  if (std::ranges::count(whole_order(), type.section) == 0) whole_order().push_back(type.section);
  all_types().push_back(std::move(type));
  ++added;
}

void add_material(MaterialType type) {
  for (ModuleType& solid : all_types()) {
    const auto word = std::ranges::find(solid.keys, "material.type", &Key::path);
    if (solid.section != "solid" || word == solid.keys.end()) continue;
    word->words.push_back(type.name);
    word->meaning += fmt::format(" {}: {}.", type.name, type.meaning);
    for (Key& key : keys_of(type)) solid.keys.push_back(std::move(key));
  }
  add_material_type(std::move(type));
  ++added;
}

std::size_t added_types() { return added; }

std::vector<std::string> physics_of(const Section& scene) {
  const std::vector<std::string> written = scene.names("");
  std::vector<std::string> named;
  std::ranges::copy_if(physics_order(), std::back_inserter(named), [&](const std::string& physics) {
    return std::ranges::count(written, physics) > 0;
  });
  return named;
}

}  // namespace perifrac
