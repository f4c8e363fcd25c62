#include "modules/fluid/fluid_type.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/body/fluid_weight.hpp"
#include "modules/fluid/as_published/one_sided_wall_force.hpp"
#include "modules/fluid/as_published/paper_exchange.hpp"
#include "modules/fluid/as_published/smoothed_exchange.hpp"
#include "modules/fluid/exchange/bond_flux_exchange.hpp"
#include "modules/fluid/fluid_scene_checks.hpp"
#include "modules/fluid/free_fluid.hpp"
#include "modules/fluid/points/fluid_blocks.hpp"
#include "modules/fluid/walls/fluid_walls.hpp"
#include "modules/fluid/walls/two_sided_wall_force.hpp"

namespace perifrac {

namespace {

FluidProperties read_properties(const Section& section) {
  FluidProperties fluid{.density = section.number("density"),
                        .bulk_modulus = section.number("bulk_modulus"),
                        .viscosity = section.number("viscosity")};
  if (section.word("equation_of_state") == "tait") {
    fluid.tait_exponent = section.number("tait_exponent");
  }
  return fluid;
}

template <int D>
double read_spacing(const Section& section, const Body<D>* body) {
  if (section.has("spacing")) return section.number("spacing");
  if (body == nullptr) section.fail("spacing", "missing", "the distance between fluid points");
  return body->spacing();
}

/// Null where no mass passes between fluid and body.
template <int D>
std::unique_ptr<Exchange<D>> make_exchange(const Section& scene, const Body<D>* body,
                                           const FluidWalls<D>& walls, const FluidScheme& scheme,
                                           const PairInfluence& influence) {
  if (body == nullptr || !scene.has("pore_flow")) return nullptr;
  const std::string word = scene.word("interface.exchange");
  if (word == "none") return nullptr;
  std::unique_ptr<Exchange<D>> exchange;
  if (word == "paper") {
    exchange = std::make_unique<PaperExchange<D>>(*body, walls.cloud, walls.period, scheme.horizon,
                                                  influence);
  } else {
    exchange = std::make_unique<BondFluxExchange<D>>(*body, walls.cloud, walls.rigid, walls.period,
                                                     scheme.horizon, influence);
  }
  const double smoothing = scene.number("interface.smoothing");
  if (smoothing == 0.0) return exchange;
  return std::make_unique<SmoothedExchange<D>>(std::move(exchange), smoothing, *body, walls.cloud,
                                               walls.period, scheme.horizon, influence);
}

/// Null where damaged points of the body are walls as intact ones; else all its points are.
template <int D>
std::unique_ptr<DamagedWalls<D>> make_damaged_walls(const Section& scene, const Body<D>* body,
                                                    WallCloud<D>& cloud) {
  if (body == nullptr || scene.word("interface.damaged_rock") == "wall") return nullptr;
  if (!scene.has("damage") || scene.word("solid.type") == "rigid") {
    scene.fail("interface.damaged_rock", "'open' where no rock is damaged",
               "a section 'damage' and a solid that breaks, or wall");
  }
  if (scene.has("crack_fluid")) {
    scene.fail("interface.damaged_rock", "'open' beside crack_fluid, which fills the same cracks",
               "one of the two");
  }
  if (scene.has("pore_flow") && scene.word("interface.exchange") == "bond_flux") {
    scene.fail("interface.damaged_rock", "'open' beside fluid that seeps through surfaces",
               "wall, or exchange: paper or none");
  }
  add_inner_points(*body, scene.word("interface.slip") == "free", cloud);
  return std::make_unique<DamagedWalls<D>>(cloud);
}

template <int D>
std::unique_ptr<WallForce<D>> make_wall_force(const Section& scene) {
  if (!scene.has("interface") || scene.word("interface.force") == "two_sided") {
    return std::make_unique<TwoSidedWallForce<D>>();
  }
  return std::make_unique<OneSidedWallForce<D>>(scene.number("interface.repulsion"));
}

template <int D>
std::unique_ptr<PhysicsModule> make_fluid(const FluidMethodType& type, const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const Section scene = section.scene();
  const FluidProperties fluid = read_properties(section);
  const double spacing = read_spacing(section, body.get());
  FluidScheme scheme{.spacing = spacing,
                     .horizon = section.number("horizon_ratio") * spacing,
                     .artificial_viscosity = section.number("artificial_viscosity"),
                     .wall_viscosity = section.number("wall_viscosity"),
                     .density_diffusion = section.number("density_diffusion"),
                     .shifting = section.number("particle_shifting"),
                     .courant = section.number("courant")};
  auto method = std::get<FluidMethodType::Maker<D>>(type.make)(scheme);
  const Vector<D> gravity = read_gravity<D>(section);
  check_fluid_scene(section, body.get(), fluid, spacing);
  FluidPoints<D> points = read_fluid_blocks<D>(section, fluid, spacing, gravity);
  const bool body_slips = body && scene.word("interface.slip") == "free";
  FluidWalls<D> walls =
      read_fluid_walls<D>(section, body.get(), body_slips, spacing, scheme.horizon);
  const std::size_t body_points = body ? body->points().size() : 0;
  auto damaged_walls = make_damaged_walls<D>(scene, body.get(), walls.cloud);
  auto exchange = make_exchange<D>(scene, body.get(), walls, scheme, method->influence());
  const bool exchanges = exchange != nullptr;
  const std::vector<Vector<D>> mouths = read_mouths<D>(scene, body.get());
  if (exchanges || !mouths.empty()) scheme.merge_below = scene.number("interface.merge_below");
  FluidOpenings<D> openings = read_fluid_openings(section, body.get(), walls, fluid, spacing);
  if (!mouths.empty()) {
    openings.mouths = std::make_unique<FluidMouths<D>>(mouths, *body, scheme.horizon);
  }
  auto dynamics = std::make_unique<FluidDynamics<D>>(
      fluid, scheme, std::move(method), gravity, std::move(walls.period), std::move(points),
      std::move(walls.cloud), std::move(walls.rigid), body_points, std::move(openings),
      make_wall_force<D>(scene), std::move(exchange), std::move(damaged_walls));
  check_fluid_steps(section, *dynamics);
  return std::make_unique<FreeFluid<D>>(std::move(body), exchanges, std::move(dynamics));
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table
KeyTable fluid_keys(const FluidMethodType& method) {
  KeyTable keys = {
      {.path = "spacing",
       .unit = "m",
       .range = "(0, inf)",
       .meaning = "Distance between fluid points at the start; the body's where left out."},
      {.path = "horizon_ratio",
       .range = "[1.5, 5]",
       .fallback = "2.5",
       .meaning = "Horizon over spacing."},
      {.path = "density",
       .unit = "kg/m^3",
       .range = "(0, inf)",
       .fallback = "1000 kg/m^3",
       .meaning = "Density at zero pressure."},
      {.path = "bulk_modulus",
       .unit = "Pa",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Bulk modulus at zero pressure. Steps are as short as sound is fast."},
      {.path = "viscosity",
       .unit = "Pa s",
       .range = "[0, inf)",
       .required = true,
       .meaning = "Dynamic viscosity."},
      {.path = "equation_of_state",
       .type = KeyType::word,
       .fallback = "linear",
       .words = {"linear", "tait"},
       .meaning = "How pressure follows density."},
      {.path = "tait_exponent",
       .range = "(1, inf)",
       .fallback = "7",
       .meaning = "tait: how fast the fluid stiffens under pressure."},
      {.path = "artificial_viscosity",
       .range = "[0, 1]",
       .fallback = "0.1",
       .meaning = "Least kinematic viscosity between fluid points, over sound speed times spacing; "
                  "walls see the physical one alone."},
      {.path = "wall_viscosity",
       .range = "[0, 1]",
       .fallback = "0",
       .meaning =
           "The same between fluid and walls that do not slip: friction that flow along walls "
           "does not have, for fluid at rest under pressure, which would creep along them."},
      {.path = "density_diffusion",
       .range = "[0, 1]",
       .fallback = "0.5",
       .meaning =
           "Diffusivity of density, over sound speed times spacing; keeps pressures smooth."},
      {.path = "particle_shifting",
       .range = "[0, 10]",
       .fallback = "4",
       .meaning = "How strongly points move away from crowds as they flow; 0: not at all."},
      {.path = "courant",
       .range = "(0, 0.6]",
       .fallback = "0.35",
       .meaning = "Step over the time that sound and fluid take across a spacing."},
  };
  for (const KeyTable& part :
       {fluid_block_keys(), fluid_wall_keys(), inlet_keys(), outlet_keys(), fluid_domain_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  for (Key& key : keys) {
    const auto own = method.fallbacks.find(key.path);
    if (own != method.fallbacks.end()) key.fallback = own->second;
  }
  return keys;
}

const KeyTable& interface_keys() {
  static const KeyTable keys = {
      {.path = "exchange",
       .type = KeyType::word,
       .fallback = "bond_flux",
       .words = {"bond_flux", "paper", "none"},
       .meaning = "How mass passes between fluid and pores, where the body has pores. bond_flux: "
                  "one flux for each bond across; keeps mass. paper: as published, for comparison; "
                  "makes and loses mass."},
      {.path = "smoothing",
       .range = "[0, 1]",
       .fallback = "0",
       .meaning = "Coefficient C of the published smoothing of density across the interface, in "
                  "every step; what a point of the body gains the fluid points of its mean give: a "
                  "leak that permeability has no say in."},
      {.path = "force",
       .type = KeyType::word,
       .fallback = "two_sided",
       .words = {"two_sided", "one_sided"},
       .meaning = "How fluid and all walls press on each other. one_sided: as published, for "
                  "comparison; misses half of the pressure."},
      {.path = "repulsion",
       .range = "[0, inf)",
       .fallback = "1",
       .when = "force=one_sided",
       .meaning = "Coefficient of the repulsion that makes up for it where it is strong enough."},
      {.path = "damaged_rock",
       .type = KeyType::word,
       .fallback = "wall",
       .words = {"wall", "open"},
       .meaning = "What broken bonds change. wall: nothing, fluid stays out of the body. open: as "
                  "published, for comparison; a point stands in for fluid by the part of its bonds "
                  "that it has left, and only repulsion keeps fluid off it."},
      {.path = "merge_below",
       .range = "[0, 0.5]",
       .fallback = "0.1",
       .meaning = "Where mass passes: fluid points under this part of their mass are merged into "
                  "their neighbours."},
      {.path = "slip",
       .type = KeyType::word,
       .fallback = "no_slip",
       .words = {"no_slip", "free"},
       .meaning = "no_slip: fluid sticks to the body. free: no friction."},
  };
  return keys;
}

std::unique_ptr<PhysicsModule> make_fluid(const FluidMethodType& method, const Section& section,
                                          const AnyBody& body) {
  return std::visit([&](const auto& of_one) { return make_fluid(method, section, of_one); }, body);
}

}  // namespace perifrac
