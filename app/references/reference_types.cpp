#include "app/references/reference_types.hpp"

#include <algorithm>

#include "app/references/rock.hpp"
#include "app/references/table_reference.hpp"

namespace perifrac {

const std::vector<ReferenceType>& reference_types() {
  static const std::vector<ReferenceType> types = {
      {"mandel", make_mandel_reference},
      {"terzaghi", make_terzaghi_reference},
      {"layered_column", make_layered_column_reference},
      {"cryer", make_cryer_reference},
      {"diffusion", make_diffusion_reference},
      {"drained_plate", make_drained_plate_reference},
      {"cantilever", make_cantilever_reference},
      {"hydrostatic", make_hydrostatic_reference},
      {"poiseuille", make_poiseuille_reference},
      {"dam_break", make_dam_break_reference},
      {"constant_head", make_constant_head_reference},
      {"water_on_plate", make_water_on_plate_reference},
      {"kgd", make_kgd_reference},
      {"radial", make_radial_reference},
      {"slit_flow", make_slit_flow_reference},
      {"table", make_table_reference},
  };
  return types;
}

std::unique_ptr<Reference> make_reference(const Section& scene, const Simulation& simulation) {
  if (!scene.has("reference")) return nullptr;
  const bool is_table = scene.word("reference.type") == "table";
  if (const auto scatter = scatter_of_rock(scene); scatter && !is_table) {
    scene.fail(*scatter, "the exact solution is for a rock that is the same everywhere",
               "a scene without it, or without 'reference'");
  }
  if (!is_table && scene.has("body.from") &&
      std::ranges::any_of(scene.numbers("body.from"), [](double x) { return x != 0.0; })) {
    scene.fail("body.from", "the reference's body begins at the origin", "this left out");
  }
  const auto type =
      std::ranges::find(reference_types(), scene.word("reference.type"), &ReferenceType::name);
  return type->make(scene, simulation);
}

}  // namespace perifrac
