#include "modules/solid/damage_keys.hpp"

#include <limits>

namespace perifrac {

KeyTable damage_keys() {
  return {
      {.path = "type",
       .type = KeyType::word,
       .required = true,
       .words = {"energy_release"},
       .meaning = "energy_release: a crack goes on where the energy that growth sets free, J at "
                  "its tracked tip, reaches the fracture energy."},
      {.path = "fracture_energy",
       .unit = "J/m^2",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Energy that new crack takes per area of it, both faces together."}};
}

double read_fracture_energy(const Section& scene) {
  if (!scene.has("damage")) return std::numeric_limits<double>::infinity();
  return scene.number("damage.fracture_energy");
}

}  // namespace perifrac
