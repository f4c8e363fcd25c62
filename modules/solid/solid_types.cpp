#include "modules/solid/solid_types.hpp"

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

KeyTable quasi_static_keys() {
  KeyTable keys = material_keys();
  const KeyTable boundary = solid_boundary_keys();
  keys.insert(keys.end(), boundary.begin(), boundary.end());
  return keys;
}

/// A rigid solid uses no key, but takes those of a deforming one, so that one word swaps them.
KeyTable rigid_keys() {
  KeyTable keys = quasi_static_keys();
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
          .keys = quasi_static_keys(),
          .make = [](const Section& section, const AnyBody& any) {
            return std::visit([&](const auto& body) { return make_quasi_static(section, body); },
                              any);
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
