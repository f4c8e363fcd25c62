#include "app/references/pore_rock.hpp"

#include <algorithm>

#include "app/references/comparison.hpp"
#include "modules/pore_flow/mobility.hpp"
#include "modules/pore_flow/pore_material.hpp"

namespace perifrac {

namespace {

/// The place of a region among the materials: after the body's own, in the scene's order.
std::size_t place_of(const Section& flow, const std::string& region) {
  if (!flow.has("regions")) return 0;
  const std::vector<std::string> names = flow.names("regions");
  const auto found = std::ranges::find(names, region);
  return found == names.end() ? 0 : found - names.begin() + 1;
}

}  // namespace

PoreRock read_pore_rock(const Section& scene, const std::string& problem,
                        const std::string& region) {
  require_word(scene, problem, "pore_flow.fluid.equation_of_state", {"linear"});
  const Section flow = scene.at("pore_flow");
  const PoreFluid fluid = read_pore_fluid(flow);
  const std::size_t place = place_of(flow, region);
  const PoreMaterial pore = read_pore_materials(flow, fluid)[place];
  const double mobility = scene.integer("dimension") == 2
                              ? isotropic_part<2>(read_mobilities<2>(flow, fluid.viscosity)[place])
                              : isotropic_part<3>(read_mobilities<3>(flow, fluid.viscosity)[place]);
  if (mobility < 0.0) {
    scene.fail("reference.type", "this scene is not " + problem,
               "a permeability that is the same along every axis");
  }
  return {pore.biot_coefficient, pore.storage, mobility};
}

}  // namespace perifrac
