#include "modules/solid/damage_keys.hpp"

#include <algorithm>
#include <limits>

#include "modules/solid/stretch_limit.hpp"

namespace perifrac {

KeyTable damage_keys() {
  KeyTable keys = {
      {.path = "type",
       .type = KeyType::word,
       .required = true,
       .words = {"energy_release", "critical_stretch"},
       .meaning = "energy_release: a crack goes on where the energy that growth sets free "
                  "at its tip reaches the fracture energy, in 3D in its plane; "
                  "critical_stretch (dynamic solid): a bond breaks where it is stretched too far. "
                  "docs/fracture.md compares them."},
      {.path = "fracture_energy",
       .unit = "J/m^2",
       .range = "(0, inf)",
       .meaning = "Energy that new crack takes per area of it, both faces together."},
      {.path = "tensile_strength",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "energy_release beside a quasi_static solid, 2D: effective tension at which a "
                  "crack begins where there is none. Without it cracks only grow from `cracks`."},
      {.path = "regions.*.tensile_strength",
       .unit = "Pa",
       .range = "(0, inf)",
       .meaning = "The same in a region of the body (body.regions)."},
      {.path = "regions.*.fracture_energy",
       .unit = "J/m^2",
       .range = "(0, inf)",
       .meaning = "energy_release: the same in a region of the body (body.regions)."},
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
  for (Key& key : scatter_keys("scatter", "energy_release: the fracture energy")) {
    keys.push_back(std::move(key));
  }
  return keys;
}

namespace {

double required_fracture_energy(const Section& scene) {
  if (!scene.has("damage.fracture_energy")) {
    scene.fail("damage", "missing key 'fracture_energy'", "a number in J/m^2");
  }
  return scene.number("damage.fracture_energy");
}

/// What regions of the body have of `key`; each has something of its own.
template <int D>
void read_by_region(const Section& scene, const Body<D>& body, const std::string& key,
                    ByRegion<D, double>& values) {
  if (!scene.has("damage.regions")) return;
  for (const std::string& name : scene.names("damage.regions")) {
    const std::string path = "damage.regions." + name;
    const auto found = std::ranges::find(body.regions(), name, &Region<D>::name);
    if (found == body.regions().end()) {
      std::vector<std::string> known;
      for (const Region<D>& region : body.regions()) known.push_back(region.name);
      scene.fail_unknown(path, name, known);
    }
    if (!scene.has(path + ".fracture_energy") && !scene.has(path + ".tensile_strength")) {
      scene.fail(path, "missing key 'fracture_energy'", "a number in J/m^2");
    }
    if (scene.has(path + "." + key)) {
      values.inside.emplace_back(*found, scene.number(path + "." + key));
    }
  }
}

}  // namespace

bool names_critical_stretch(const Section& scene) {
  return scene.has("damage") && scene.word("damage.type") == "critical_stretch";
}

template <int D>
FractureEnergy<D> read_fracture_energy(const Section& scene, const Body<D>& body) {
  if (!scene.has("damage")) return {{std::numeric_limits<double>::infinity()}};
  if (names_critical_stretch(scene)) {
    scene.fail("damage.type", "'critical_stretch' in a quasi_static solid", "energy_release");
  }
  FractureEnergy<D> energy{{required_fracture_energy(scene)}};
  energy.scatter = read_scatter<D>(scene, "damage.scatter");
  read_by_region(scene, body, "fracture_energy", energy.by_region);
  return energy;
}

template <int D>
std::optional<TensileStrength<D>> read_tensile_strength(const Section& scene, const Body<D>& body) {
  if (!scene.has("damage")) return {};
  if (!scene.has("damage.tensile_strength")) {
    ByRegion<D, double> none{};
    read_by_region(scene, body, "tensile_strength", none);
    if (none.inside.empty()) return {};
    scene.fail("damage", "missing key 'tensile_strength'", "a number in Pa");
  }
  if constexpr (D == 3) {
    scene.fail("damage.tensile_strength", "in 3D", "a list 'cracks', or dimension: 2");
  }
  TensileStrength<D> strength{{scene.number("damage.tensile_strength")}};
  strength.scatter = read_scatter<D>(scene, "damage.scatter");
  read_by_region(scene, body, "tensile_strength", strength.by_region);
  return strength;
}

template <int D>
double read_stretch_limit(const Section& scene, const Body<D>& body, const Family<D>& family,
                          const IsotropicElasticity<D>& law) {
  for (const char* key : {"damage.regions", "damage.scatter", "damage.tensile_strength"}) {
    if (scene.has(key)) scene.fail(key, "with critical_stretch", "energy_release");
  }
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

template FractureEnergy<2> read_fracture_energy<2>(const Section&, const Body<2>&);
template FractureEnergy<3> read_fracture_energy<3>(const Section&, const Body<3>&);
template std::optional<TensileStrength<2>> read_tensile_strength<2>(const Section&, const Body<2>&);
template std::optional<TensileStrength<3>> read_tensile_strength<3>(const Section&, const Body<3>&);
template double read_stretch_limit<2>(const Section&, const Body<2>&, const Family<2>&,
                                      const IsotropicElasticity<2>&);
template double read_stretch_limit<3>(const Section&, const Body<3>&, const Family<3>&,
                                      const IsotropicElasticity<3>&);

}  // namespace perifrac
