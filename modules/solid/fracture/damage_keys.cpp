#include "modules/solid/fracture/damage_keys.hpp"

#include <algorithm>
#include <limits>

#include "core/geometry/region.hpp"
#include "modules/solid/fracture/stretch_limit.hpp"

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
      {.path = "fracture_toughness",
       .unit = "Pa*sqrt(m)",
       .range = "(0, inf)",
       .meaning = "In place of fracture_energy: K_IC of mode I in plane strain, which makes it "
                  "K_IC^2 (1 - nu^2) / E of the rock at that place."},
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
      {.path = "regions.*.fracture_toughness",
       .unit = "Pa*sqrt(m)",
       .range = "(0, inf)",
       .meaning = "In place of its fracture_energy."},
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

/// The energy of a place, `prefix` as in `damage.` or `damage.regions.rock.`, where the rock has
/// this E'; nothing where the scene says neither energy nor toughness.
std::optional<double> energy_at(const Section& scene, const std::string& prefix, double modulus) {
  const std::string energy = prefix + "fracture_energy", toughness = prefix + "fracture_toughness";
  if (!scene.has(toughness)) {
    return scene.has(energy) ? std::optional(scene.number(energy)) : std::nullopt;
  }
  if (scene.has(energy)) {
    scene.fail(toughness, "beside fracture_energy", "one of the two: Gc = K_IC^2 (1 - nu^2) / E");
  }
  return scene.number(toughness) * scene.number(toughness) / modulus;
}

double modulus_at(const Section& scene, const std::string& material) {
  return read_isotropic_elasticity<3>(scene.at("solid"), material).plane_strain_modulus();
}

template <int D>
Region<D> common_part(const Region<D>& one, const Region<D>& other) {
  Region<D> both = one;
  for (int a = 0; a < D; ++a) {
    both.from[a] = std::max(one.from[a], other.from[a]);
    both.to[a] = std::min(one.to[a], other.to[a]);
  }
  return both;
}

/// Within a part of the body, null for all of it, energy follows toughness from rock to rock.
template <int D>
void add_rocks(const Section& scene, const Body<D>& body, const std::string& prefix,
               const Region<D>* part, ByRegion<D, double>& energy) {
  if (!scene.has(prefix + "fracture_toughness")) return;
  for (const std::string& name : scene.names("solid.regions")) {
    const std::string material = "regions." + name + ".material";
    const auto rock = std::ranges::find(body.regions(), name, &Region<D>::name);
    if (!scene.has("solid." + material) || rock == body.regions().end()) continue;
    energy.inside.emplace_back(part == nullptr ? *rock : common_part<D>(*rock, *part),
                               *energy_at(scene, prefix, modulus_at(scene, material)));
  }
}

/// The regions of the body that `damage` names; each has something of its own.
template <int D>
std::vector<Region<D>> read_damage_regions(const Section& scene, const Body<D>& body) {
  std::vector<Region<D>> regions;
  if (!scene.has("damage.regions")) return regions;
  region_of_points<D>(scene.at("damage"), body.regions(), body.points());  // says what is wrong
  for (const std::string& name : scene.names("damage.regions")) {
    const std::string path = "damage.regions." + name;
    if (!scene.has(path + ".fracture_energy") && !scene.has(path + ".fracture_toughness") &&
        !scene.has(path + ".tensile_strength")) {
      scene.fail(path, "missing key 'fracture_energy'", "a number in J/m^2");
    }
    regions.push_back(*std::ranges::find(body.regions(), name, &Region<D>::name));
  }
  return regions;
}

}  // namespace

bool names_critical_stretch(const Section& scene) {
  return scene.has("damage") && scene.word("damage.type") == "critical_stretch";
}

double read_fracture_energy(const Section& scene) {
  const auto energy = energy_at(scene, "damage.", modulus_at(scene, "material"));
  if (!energy) {
    scene.fail("damage", "missing key 'fracture_energy'",
               "a number in J/m^2, or fracture_toughness in Pa*sqrt(m)");
  }
  return *energy;
}

template <int D>
FractureEnergy<D> read_fracture_energy(const Section& scene, const Body<D>& body) {
  if (!scene.has("damage")) return {{std::numeric_limits<double>::infinity()}};
  if (names_critical_stretch(scene)) {
    scene.fail("damage.type", "'critical_stretch' in a quasi_static solid", "energy_release");
  }
  FractureEnergy<D> energy{{read_fracture_energy(scene)}};
  energy.scatter = read_scatter<D>(scene, "damage.scatter");
  add_rocks<D>(scene, body, "damage.", nullptr, energy.by_region);
  for (const Region<D>& region : read_damage_regions(scene, body)) {
    const std::string prefix = "damage.regions." + region.name + ".";
    const auto inside = energy_at(scene, prefix, modulus_at(scene, "material"));
    if (!inside) continue;
    energy.by_region.inside.emplace_back(region, *inside);
    add_rocks<D>(scene, body, prefix, &region, energy.by_region);
  }
  return energy;
}

template <int D>
std::optional<TensileStrength<D>> read_tensile_strength(const Section& scene, const Body<D>& body) {
  if (!scene.has("damage")) return {};
  const auto in_region = [&](const Region<D>& region) {
    return "damage.regions." + region.name + ".tensile_strength";
  };
  const std::vector<Region<D>> regions = read_damage_regions(scene, body);
  if (!scene.has("damage.tensile_strength")) {
    if (std::ranges::none_of(regions, [&](const auto& r) { return scene.has(in_region(r)); })) {
      return {};
    }
    scene.fail("damage", "missing key 'tensile_strength'", "a number in Pa");
  }
  if constexpr (D == 3) {
    scene.fail("damage.tensile_strength", "in 3D", "a list 'cracks', or dimension: 2");
  }
  TensileStrength<D> strength{{scene.number("damage.tensile_strength")}};
  strength.scatter = read_scatter<D>(scene, "damage.scatter");
  for (const Region<D>& region : regions) {
    if (!scene.has(in_region(region))) continue;
    strength.by_region.inside.emplace_back(region, scene.number(in_region(region)));
  }
  return strength;
}

template <int D>
double read_stretch_limit(const Section& scene, const Body<D>& body, const Family<D>& family,
                          const IsotropicElasticity<D>& law) {
  for (const char* key : {"damage.regions", "damage.scatter", "damage.tensile_strength"}) {
    if (scene.has(key)) scene.fail(key, "with critical_stretch", "energy_release");
  }
  if (scene.has("damage.stretch")) {
    for (const std::string other : {"fracture_energy", "fracture_toughness"}) {
      if (!scene.has("damage." + other)) continue;
      scene.fail("damage.stretch", "beside " + other, "one of the two");
    }
    return scene.number("damage.stretch");
  }
  const double energy = read_fracture_energy(scene);
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
