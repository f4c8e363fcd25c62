#include "modules/solid/solid_types.hpp"

#include <algorithm>

#include "modules/solid/dynamic_solid.hpp"
#include "modules/solid/material.hpp"
#include "modules/solid/quasi_static_solid.hpp"
#include "modules/solid/rigid_solid.hpp"
#include "modules/solid/solid_boundary_keys.hpp"

namespace perifrac {

namespace {

template <int D>
std::unique_ptr<PhysicsModule> make_quasi_static(const Section& section,
                                                 std::shared_ptr<const Body<D>> body) {
  const SolidBoundary<D> boundary = read_solid_boundary<D>(section, *body);
  std::shared_ptr<ElasticOperator<D>> elastic = read_material<D>(section, *body, boundary);
  auto solid = std::make_unique<QuasiStaticSolid<D>>(body, std::move(elastic), boundary);
  if (const std::string motion = solid->free_motion(); !motion.empty()) {
    section.fail(section.has("boundary") ? "boundary" : "", "nothing holds the body: " + motion,
                 "faces of type roller, fixed or rigid_plate that hold every motion");
  }
  return solid;
}

template <int D>
std::unique_ptr<PhysicsModule> make_dynamic(const Section& section,
                                            std::shared_ptr<const Body<D>> body) {
  const SolidBoundary<D> boundary = read_solid_boundary<D>(section, *body);
  std::shared_ptr<ElasticOperator<D>> elastic = read_material<D>(section, *body, boundary);
  return std::make_unique<DynamicSolid<D>>(body, std::move(elastic), boundary,
                                           section.number("density"), section.number("damping"),
                                           section.number("integrator.safety"));
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
          .meaning = "Elastic solid in equilibrium at every window's end; one factorisation.",
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
          .make = [](const Section&, const AnyBody&) -> std::unique_ptr<PhysicsModule> {
            return std::make_unique<RigidSolid>();
          }};
}

}  // namespace perifrac
