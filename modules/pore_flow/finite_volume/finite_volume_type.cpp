#include "modules/pore_flow/finite_volume/finite_volume_type.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "modules/pore_flow/darcy_type.hpp"
#include "modules/pore_flow/finite_volume/two_point_flow.hpp"
#include "modules/pore_flow/flow_in_scene.hpp"
#include "modules/pore_flow/material/mobility.hpp"
#include "modules/pore_flow/material/region_path.hpp"

namespace perifrac {

namespace {

/// Two points tell the flux through the wall between them where K n points along n.
template <int D>
void check_tensors(const Section& section, const Body<D>& body,
                   const std::vector<Tensor<D, D>>& mobilities) {
  const std::vector<std::string> regions = region_prefixes(section);
  for (std::size_t r = 0; r < mobilities.size(); ++r) {
    bool along_axes = true;
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < D; ++b)
        along_axes = along_axes && (a == b || mobilities[r][a * D + b] == 0.0);
    }
    if (body.irregular() ? isotropic_part<D>(mobilities[r]) >= 0.0 : along_axes) continue;
    section.fail(path_in_region(section, regions[r], "permeability_tensor"),
                 body.irregular() ? "two-point fluxes between irregular points carry no tensor"
                                  : "two-point fluxes carry no tensor across the lattice",
                 body.irregular() ? "a scalar permeability, or type: darcy"
                                  : "components of the axes alone, or type: darcy");
  }
}

template <int D>
std::unique_ptr<PhysicsModule> make_finite_volume(const Section& section,
                                                  std::shared_ptr<const Body<D>> body) {
  if (std::ranges::any_of(body->faces(), &Face::curved)) {
    section.fail("type", "'finite_volume' on a body with a curved face",
                 "darcy, or a body with plane faces");
  }
  const FlowInScene<D> scene = read_flow(section, *body);
  check_tensors(section, *body, scene.mobilities);
  const CellFaces<D> walls =
      body->irregular() ? voronoi_cell_faces(body->points(), body->faces(), body->spacing())
                        : lattice_cell_faces(body->points(), body->faces(), body->spacing());
  Discretisation<D> space;
  if (scene.boundary.has_sources()) {
    space.sources = scene.boundary.sources_by([&](int face) {
      Eigen::VectorXd area = Eigen::VectorXd::Zero(body->points().size());
      for (const auto& wall : walls.outer) {
        if (wall.face == face) area[wall.i] = wall.area;
      }
      return area;
    });
  }
  const Family<D> no_ghosts;
  const MirrorCondition<D, 1> pressures = scene.boundary.mirror_condition(no_ghosts);
  const OuterWalls<D> outer{scene.boundary.sealed(), pressures,
                            scene.boundary.held_points(pressures)};
  space.flow =
      std::make_unique<TwoPointFlow<D>>(body, walls, outer, read_law(section, *body, scene));
  auto equations = make_equations(section, body, scene, pressures, std::move(space));
  return make_flow_module(section, std::move(body), std::move(equations));
}

/// It takes the keys of darcy's operators too, so that one word swaps them.
KeyTable finite_volume_keys() {
  KeyTable keys = flow_keys();
  for (Key& key : darcy_operator_keys()) {
    key.meaning = "Of type darcy; may stay where that word is swapped, and does nothing.";
    keys.push_back(std::move(key));
  }
  return keys;
}

}  // namespace

ModuleType finite_volume_type() {
  return {.section = "pore_flow",
          .name = "finite_volume",
          .meaning =
              "Pore flow after Darcy by finite volumes, one flux between neighbouring cells: "
              "squares and cubes on a lattice, Voronoi cells of other points. Pressure on a "
              "face is held at the face, and flow across regions is exact on a lattice.",
          .keys = finite_volume_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_finite_volume(section, body); },
                              any);
          }};
}

}  // namespace perifrac
