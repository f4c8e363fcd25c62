#include "modules/solid/solid_types.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/body/crack_list.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/config/mistakes.hpp"
#include "modules/solid/boundary/solid_boundary_keys.hpp"
#include "modules/solid/dynamic_fracture.hpp"
#include "modules/solid/dynamic_solid.hpp"
#include "modules/solid/equilibrium/stiffness_solver.hpp"
#include "modules/solid/fracture/crack_friction_keys.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/fracture/short_seeds.hpp"
#include "modules/solid/fracturing_solid.hpp"
#include "modules/solid/material/material.hpp"
#include "modules/solid/material/stress_at_rest.hpp"
#include "modules/solid/quasi_static_solid.hpp"
#include "modules/solid/rigid_slits.hpp"
#include "modules/solid/rigid_solid.hpp"

namespace perifrac {

namespace {

/// Throws InputError where cracks that are to grow are too short to.
template <int D>
void check_growing_seeds(const Section& scene, const Body<D>& body, const Family<D>& cut) {
  if (scene.has("damage")) check_seeds_can_grow<D>(scene, body, cut, read_cracks(scene, body));
}

/// What a scene's cracks that facets make are.
template <int D>
struct Cracks {
  std::vector<CrackFacet<D>> seeds;
  FractureEnergy<D> fracture_energy;
  std::optional<TensileStrength<D>> tensile_strength;
};

template <int D>
Cracks<D> read_growing_cracks(const Section& section, const Body<D>& body) {
  const Section scene = section.scene();
  Cracks<D> cracks{.seeds = all_facets<D>(read_cracks(scene, body)),
                   .fracture_energy = read_fracture_energy(scene, body),
                   .tensile_strength = read_tensile_strength(scene, body)};
  if (cracks.seeds.empty() && !cracks.tensile_strength) {
    scene.fail("damage", "no crack to grow",
               "a list 'cracks' with one crack or more, or damage.tensile_strength");
  }
  return cracks;
}

/// What a solid with such cracks is made of. All of it is read, so that all mistakes are told.
template <int D>
struct CrackedParts {
  CrackedParts(const Section& section, const Body<D>& body) : boundary(body) {
    Mistakes mistakes;
    mistakes.note([&] { cracks = read_growing_cracks(section, body); });
    mistakes.note([&] { boundary = read_solid_boundary<D>(section, body); });
    mistakes.note([&] { stress = read_initial_stress<D>(section, body); });
    mistakes.throw_if_any();
  }

  Cracks<D> cracks;
  SolidBoundary<D> boundary;
  std::optional<InitialStress<D>> stress;
};

/// A plate without mass follows from a linear equilibrium.
template <int D>
void check_plates_have_mass(const Section& section, const Body<D>& body,
                            const SolidBoundary<D>& boundary, const std::string& beside) {
  const auto mirror = boundary.mirror_condition(*body.family(boundary.mirrored()));
  for (const auto& plate : boundary.plates(mirror)) {
    const auto face = std::ranges::find(body.faces(), plate.face, &Face::name);
    if (!body.layer(static_cast<int>(face - body.faces().begin())).empty()) continue;
    section.fail(fmt::format("boundary.{}.type", plate.face),
                 "a plate without mass beside " + beside,
                 fmt::format("body.boundary.{}: layer{}", plate.face,
                             is_corotational(section) ? ", or kinematics: small" : ""));
  }
}

/// What does not turn with the body.
template <int D>
void check_large_rotations(const Section& section, const Body<D>& body,
                           const SolidBoundary<D>& boundary) {
  if (!is_corotational(section)) return;
  const auto refuse = [&](const std::string& key, const std::string& problem,
                          const std::string& expected) {
    section.fail(key, problem + " beside kinematics: corotational",
                 expected + ", or kinematics: small");
  };
  if (section.word("material.type") != "linear_exact") {
    refuse("material.type", fmt::format("'{}'", section.word("material.type")), "linear_exact");
  }
  for (const char* stress : {"confining_stress", "total_stress"}) {
    if (section.has(stress)) refuse(stress, "a stress of the body at rest", "loads on the faces");
  }
  if (body.family(boundary.mirrored())->curved) {
    refuse("boundary", "a mirrored sphere", "a free sphere");
  }
  check_plates_have_mass(section, body, boundary, "kinematics: corotational");
}

template <int D>
std::unique_ptr<PhysicsModule> make_fracturing(const Section& section,
                                               std::shared_ptr<const Body<D>> body) {
  const auto& [cracks, boundary, stress] = CrackedParts<D>(section, *body);
  auto family = std::make_shared<Family<D>>(*body->family(boundary.mirrored()));
  auto elastic =
      read_breakable_material<D>(section, *body, family, boundary.mirror_condition(*family));
  auto solid = std::make_unique<FracturingSolid<D>>(
      body, family, std::move(elastic), boundary, stress, cracks.seeds, cracks.fracture_energy,
      cracks.tensile_strength, read_crack_friction(section), read_solver_choice(section));
  solid->set_pore_stress_at_rest(read_pore_stress_at_rest<D>(section, *body));
  if (const std::string motion = solid->free_motion(); !motion.empty()) {
    section.fail(section.has("boundary") ? "boundary" : "", "nothing holds the body: " + motion,
                 "faces of type roller, fixed or rigid_plate that hold every motion");
  }
  check_growing_seeds(section.scene(), *body, *family);
  return solid;
}

std::unique_ptr<PhysicsModule> make_dynamic_fracture(const Section& section,
                                                     std::shared_ptr<const Body<2>> body) {
  const auto& [cracks, boundary, stress] = CrackedParts<2>(section, *body);
  auto family = std::make_shared<Family<2>>(*body->family(boundary.mirrored()));
  std::shared_ptr<BreakableElasticity<2>> elastic =
      read_breakable_material<2>(section, *body, family, boundary.mirror_condition(*family));
  auto solid = std::make_unique<DynamicFracture>(
      body, family, std::move(elastic), boundary, section.number("density"),
      section.number("damping"), section.number("integrator.safety"), stress, cracks.seeds,
      cracks.fracture_energy);
  check_growing_seeds(section.scene(), *body, *family);
  return solid;
}

std::unique_ptr<PhysicsModule> make_dynamic_fracture(const Section& section,
                                                     std::shared_ptr<const Body<3>>) {
  section.scene().fail(section.scene().has("damage") ? "damage" : "cracks",
                       "cracks that grow by energy_release in a dynamic solid in 3D",
                       "solid.type: quasi_static, damage.type: critical_stretch or dimension: 2");
}

template <int D>
std::unique_ptr<PhysicsModule> make_quasi_static(const Section& section,
                                                 std::shared_ptr<const Body<D>> body) {
  if (has_cracks(section.scene())) return make_fracturing(section, body);
  const SolidBoundary<D> boundary = read_solid_boundary<D>(section, *body);
  std::shared_ptr<ElasticOperator<D>> elastic = read_material<D>(section, *body, boundary);
  auto solid = std::make_unique<QuasiStaticSolid<D>>(body, std::move(elastic), boundary,
                                                     read_solver_choice(section));
  solid->set_pore_stress_at_rest(read_pore_stress_at_rest<D>(section, *body));
  if (const std::string motion = solid->free_motion(); !motion.empty()) {
    section.fail(section.has("boundary") ? "boundary" : "", "nothing holds the body: " + motion,
                 "faces of type roller, fixed or rigid_plate that hold every motion");
  }
  return solid;
}

template <int D>
std::unique_ptr<CriticalStretch<D>> make_breaking(const Section& section, const Body<D>& body,
                                                  std::shared_ptr<Family<D>> family,
                                                  std::shared_ptr<BreakableElasticity<D>> elastic) {
  const Section scene = section.scene();
  if (family->curved) {
    section.fail("boundary", "bonds that break beside a mirrored sphere", "a free sphere");
  }
  for (const char* stress : {"confining_stress", "total_stress"}) {
    if (!section.has(stress)) continue;
    section.fail(stress, "beside bonds that break in a dynamic solid",
                 "loads on the faces, or type: quasi_static");
  }
  read_initial_stress<D>(section, body);  // says what regions may not have
  std::vector<CrackFacet<D>> seeds = all_facets<D>(read_cracks(scene, body));
  const double limit =
      read_stretch_limit<D>(scene, body, *family, read_isotropic_elasticity<D>(section));
  return std::make_unique<CriticalStretch<D>>(family, std::move(elastic), body.claim_bond_state(),
                                              std::move(seeds), limit);
}

template <int D>
std::unique_ptr<PhysicsModule> make_dynamic(const Section& section,
                                            std::shared_ptr<const Body<D>> body) {
  const SolidBoundary<D> boundary = read_solid_boundary<D>(section, *body);
  check_large_rotations(section, *body, boundary);
  if (!is_linear_material(section)) {
    check_plates_have_mass(section, *body, boundary,
                           "material.type: " + section.word("material.type"));
  }
  const auto make = [&](std::shared_ptr<ElasticOperator<D>> elastic,
                        std::unique_ptr<CriticalStretch<D>> breaking) {
    return std::make_unique<DynamicSolid<D>>(
        body, std::move(elastic), boundary, section.number("density"), section.number("damping"),
        section.number("integrator.safety"), std::move(breaking));
  };
  if (!has_cracks(section.scene()))
    return make(read_material<D>(section, *body, boundary), nullptr);
  if (!names_critical_stretch(section.scene())) {
    if (section.word("material.type") != "linear_exact") {
      section.fail(
          "material.type",
          fmt::format("'{}' beside cracks in a solid with inertia", section.word("material.type")),
          "linear_exact, damage.type: critical_stretch, or type: quasi_static");
    }
    return make_dynamic_fracture(section, body);
  }
  auto family = std::make_shared<Family<D>>(*body->family(boundary.mirrored()));
  std::shared_ptr<BreakableElasticity<D>> elastic =
      read_breakable_material<D>(section, *body, family, boundary.mirror_condition(*family));
  auto breaking = make_breaking<D>(section, *body, family, elastic);
  return make(std::move(elastic), std::move(breaking));
}

template <int D>
std::unique_ptr<PhysicsModule> make_rigid(const Section& section,
                                          std::shared_ptr<const Body<D>> body) {
  const Section scene = section.scene();
  if (scene.count("cracks") == 0) return std::make_unique<RigidSolid>();
  const auto cracks = read_cracks(scene, *body);
  std::vector<double> opening;
  for (std::size_t k = 0; k < cracks.size(); ++k) {
    opening.insert(opening.end(), cracks[k].size(),
                   scene.number(fmt::format("cracks[{}].opening", k)));
  }
  return std::make_unique<RigidSlits<D>>(std::move(body), all_facets<D>(cracks),
                                         std::move(opening));
}

/// Keys of one elastic solid may stand beside another, so that one word swaps them.
KeyTable elastic_keys() {
  KeyTable keys = material_keys();
  const KeyTable boundary = solid_boundary_keys();
  keys.insert(keys.end(), boundary.begin(), boundary.end());
  keys.push_back({.path = "damping",
                  .unit = "1/s",
                  .range = "[0, inf)",
                  .fallback = "0 1/s",
                  .meaning = "dynamic: rate at which a free velocity decays."});
  keys.push_back(crack_friction_key());
  for (Key& key : linear_solver_keys()) keys.push_back(std::move(key));
  keys.push_back({.path = "integrator.safety",
                  .range = "(0, 1)",
                  .fallback = "0.9",
                  .meaning = "dynamic: step over the stable limit."});
  return keys;
}

KeyTable dynamic_keys() {
  KeyTable keys = elastic_keys();
  std::ranges::find(keys, "density", &Key::path)->required = true;
  return keys;
}

/// A rigid solid uses no key, but takes those of a deforming one, so that one word swaps them.
KeyTable rigid_keys() {
  KeyTable keys = elastic_keys();
  for (Key& key : keys) {
    key.required = key.required && key.path.starts_with("boundary.");
    key.meaning = "Not used.";
  }
  return keys;
}

}  // namespace

ModuleType quasi_static_solid_type() {
  return {.section = "solid",
          .name = "quasi_static",
          .meaning = "Elastic solid in equilibrium at every window's end.",
          .keys = elastic_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_quasi_static(section, body); },
                              any);
          }};
}

ModuleType dynamic_solid_type() {
  return {.section = "solid",
          .name = "dynamic",
          .meaning = "Elastic solid with inertia; explicit, sub-steps at the stable limit.",
          .keys = dynamic_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_dynamic(section, body); }, any);
          }};
}

ModuleType rigid_solid_type() {
  return {.section = "solid",
          .name = "rigid",
          .meaning = "Solid that does not deform: no unknowns, no cost.",
          .keys = rigid_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_rigid(section, body); }, any);
          }};
}

}  // namespace perifrac
