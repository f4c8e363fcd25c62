#include "modules/solid/fracture/crack_friction_keys.hpp"

namespace perifrac {

namespace {

constexpr const char* name = "crack_friction";

}  // namespace

Key crack_friction_key() {
  return {
      .path = name,
      .range = "[0, inf)",
      .meaning =
          "quasi_static, 2D; beside pore_flow where crack_fluid is there too: Coulomb's "
          "coefficient of friction between faces that touch, of what presses them together beyond "
          "a fluid in the crack; left out, they bear no shear."};
}

std::unique_ptr<CrackFriction> read_crack_friction(const Section& section) {
  return section.has(name) ? std::make_unique<CrackFriction>(section.number(name)) : nullptr;
}

}  // namespace perifrac
