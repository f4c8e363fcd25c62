#include "modules/solid/damage_keys.hpp"

#include <limits>

#include "modules/solid/stretch_limit.hpp"

namespace perifrac {

KeyTable damage_keys() {
  return {
      {.path = "type",
       .type = KeyType::word,
       .required = true,
       .words = {"energy_release", "critical_stretch"},
       .meaning = "energy_release (2D): a crack goes on where the energy that "
                  "growth sets free, J at its tracked tip, reaches the fracture energy; "
                  "critical_stretch (dynamic solid): a bond breaks where it is stretched too far. "
                  "docs/fracture.md compares them."},
      {.path = "fracture_energy",
       .unit = "J/m^2",
       .range = "(0, inf)",
       .meaning = "Energy that new crack takes per area of it, both faces together."},
      {.path = "critical_stretch",
       .type = KeyType::word,
       .fallback = "corrected",
       .words = {"printed", "corrected", "calibrated"},
       .meaning = "critical_stretch: how the limit follows from the fracture energy and the "
                  "material (not its regions). printed: paper Eq 15 as it stands, 2D; corrected: "
                  "with the bulk modulus, influence function and lattice in use; calibrated: "
                  "(1 + nu)(1 - 2 nu) K_IC / (E sqrt(pi dx))."},
      {.path = "stretch",
       .range = "(0, inf)",
       .meaning = "critical_stretch: the limit itself, in place of fracture_energy."}};
}

namespace {

double required_fracture_energy(const Section& scene) {
  if (!scene.has("damage.fracture_energy")) {
    scene.fail("damage", "missing key 'fracture_energy'", "a number in J/m^2");
  }
  return scene.number("damage.fracture_energy");
}

}  // namespace

bool names_critical_stretch(const Section& scene) {
  return scene.has("damage") && scene.word("damage.type") == "critical_stretch";
}

double read_fracture_energy(const Section& scene) {
  if (!scene.has("damage")) return std::numeric_limits<double>::infinity();
  if (names_critical_stretch(scene)) {
    scene.fail("damage.type", "'critical_stretch' in a quasi_static solid", "energy_release");
  }
  return required_fracture_energy(scene);
}

template <int D>
double read_stretch_limit(const Section& scene, const Body<D>& body, const Family<D>& family,
                          const IsotropicElasticity<D>& law) {
  if (scene.has("damage.stretch")) {
    if (scene.has("damage.fracture_energy")) {
      scene.fail("damage.stretch", "beside fracture_energy", "one of the two");
    }
    return scene.number("damage.stretch");
  }
  const double energy = required_fracture_energy(scene);
  const std::string word = scene.word("damage.critical_stretch");
  if (word == "calibrated") return calibrated_stretch(law, energy, body.spacing());
  if (word == "corrected") {
    return consistent_stretch(law, energy, crossing_bonds(family, body.spacing()));
  }
  if constexpr (D == 2) {
    return printed_stretch(law, energy, body.horizon());
  } else {
    scene.fail("damage.critical_stretch", "'printed' in 3D", "corrected or calibrated");
  }
}

template double read_stretch_limit<2>(const Section&, const Body<2>&, const Family<2>&,
                                      const IsotropicElasticity<2>&);
template double read_stretch_limit<3>(const Section&, const Body<3>&, const Family<3>&,
                                      const IsotropicElasticity<3>&);

}  // namespace perifrac
