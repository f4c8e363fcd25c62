#include "app/references/rock.hpp"

#include <algorithm>

#include "app/references/comparison.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/material/pore_material.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

namespace {

/// The body's own material comes first, then those of the regions in the scene's order.
std::size_t place_among_materials(const Section& flow, const std::string& region) {
  if (!flow.has("regions")) return 0;
  const std::vector<std::string> names = flow.names("regions");
  const auto found = std::ranges::find(names, region);
  return found == names.end() ? 0 : found - names.begin() + 1;
}

}  // namespace

double ElasticRock::youngs_modulus() const {
  return shear_modulus * (3.0 * lame_lambda + 2.0 * shear_modulus) / (lame_lambda + shear_modulus);
}

bool has_elastic_rock(const Section& scene) {
  if (!writes(scene, "solid.material") || scene.word("solid.type") == "rigid") return false;
  const KeyTable constants = elastic_constant_keys();
  const std::vector<std::string> given = scene.names("solid.material");
  return std::ranges::count_if(given, [&](const std::string& name) {
           return std::ranges::count(constants, "material." + name, &Key::path) > 0;
         }) == 2;
}

ElasticRock read_elastic_rock(const Section& scene, const std::string& region) {
  const std::string there = "regions." + region + ".material";
  const auto elasticity = read_isotropic_elasticity<3>(
      scene.at("solid"), writes(scene, "solid." + there) ? there : "material");
  return {elasticity.lame_lambda, elasticity.shear_modulus};
}

PorousRock read_porous_rock(const Section& scene, const std::string& region) {
  const Section flow = scene.at("pore_flow");
  if (flow.word("fluid.equation_of_state") != "linear") {
    scene.fail("reference.type", "the exact solution is for a linear fluid",
               "pore_flow.fluid.equation_of_state: linear");
  }
  const PoreFluid fluid = read_pore_fluid(flow);
  const std::size_t place = place_among_materials(flow, region);
  const PoreMaterial pore = read_pore_materials(flow, fluid)[place];
  const double mobility = scene.integer("dimension") == 2
                              ? isotropic_part<2>(read_mobilities<2>(flow, fluid.viscosity)[place])
                              : isotropic_part<3>(read_mobilities<3>(flow, fluid.viscosity)[place]);
  if (mobility < 0.0) {
    scene.fail("reference.type", "the exact solution is for isotropic rock",
               "a permeability that is the same along every axis");
  }
  return {pore.biot_coefficient, pore.storage, mobility};
}

std::optional<std::string> scatter_of_rock(const Section& scene) {
  for (const char* const key :
       {"solid.material.scatter", "damage.scatter", "pore_flow.permeability_scatter"}) {
    if (writes(scene, key)) return key;
  }
  return {};
}

}  // namespace perifrac
