#include "core/config/key_suggestion.hpp"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>

#include "core/base/names.hpp"

namespace perifrac {

namespace {

struct OtherWord {
  std::string_view word;  ///< without '_' and '-', in small letters
  std::string_view key;
};

/// What keys are called elsewhere; of several lines of a word the first that fits counts.
constexpr auto other_words = std::to_array<OtherWord>({
    {"insitustress", "total_stress"},
    {"insitustresses", "total_stress"},
    {"initialstress", "total_stress"},
    {"initialstresses", "total_stress"},
    {"farfieldstress", "total_stress"},
    {"remotestress", "total_stress"},
    {"tectonicstress", "total_stress"},
    {"principalstresses", "total_stress"},
    {"stress", "total_stress"},
    {"stresses", "total_stress"},
    {"prestress", "total_stress"},
    {"closurestress", "total_stress"},
    {"overburden", "total_stress"},
    {"minimumhorizontalstress", "total_stress"},
    {"maximumhorizontalstress", "total_stress"},
    {"shmin", "total_stress"},
    {"shmax", "total_stress"},
    {"effectivestress", "confining_stress"},
    {"confiningpressure", "confining_stress"},
    {"confinement", "confining_stress"},
    {"toughness", "fracture_toughness"},
    {"stressintensity", "fracture_toughness"},
    {"kic", "fracture_toughness"},
    {"k1c", "fracture_toughness"},
    {"gc", "fracture_energy"},
    {"gic", "fracture_energy"},
    {"energyreleaserate", "fracture_energy"},
    {"criticalenergyreleaserate", "fracture_energy"},
    {"surfaceenergy", "fracture_energy"},
    {"strength", "tensile_strength"},
    {"e", "youngs_modulus"},
    {"young", "youngs_modulus"},
    {"youngmodulus", "youngs_modulus"},
    {"elasticmodulus", "youngs_modulus"},
    {"modulus", "youngs_modulus"},
    {"nu", "poisson_ratio"},
    {"poisson", "poisson_ratio"},
    {"poissonsratio", "poisson_ratio"},
    {"g", "shear_modulus"},
    {"perm", "permeability"},
    {"hydraulicconductivity", "permeability"},
    {"k", "permeability"},
    {"k", "bulk_modulus"},
    {"compressibility", "bulk_modulus"},
    {"phi", "porosity"},
    {"mu", "viscosity"},
    {"mu", "shear_modulus"},
    {"eta", "viscosity"},
    {"rho", "density"},
    {"biot", "biot_coefficient"},
    {"biotscoefficient", "biot_coefficient"},
    {"alpha", "biot_coefficient"},
    {"porepressure", "initial_pressure"},
    {"reservoirpressure", "initial_pressure"},
    {"initialporepressure", "initial_pressure"},
    {"dx", "spacing"},
    {"resolution", "spacing"},
    {"meshsize", "spacing"},
    {"cellsize", "spacing"},
    {"gridsize", "spacing"},
    {"horizon", "horizon_ratio"},
    {"delta", "horizon_ratio"},
    {"dimensions", "size"},
    {"length", "size"},
    {"kernel", "influence_function"},
    {"boundaries", "boundary"},
    {"boundaryconditions", "boundary"},
    {"bc", "boundary"},
    {"bcs", "boundary"},
    {"duration", "end"},
    {"tend", "end"},
    {"endtime", "end"},
    {"finaltime", "end"},
    {"flowrate", "rate"},
    {"injectionrate", "rate"},
    {"pumprate", "rate"},
    {"q", "rate"},
    {"leakoff", "leak_off"},
    {"carter", "leak_off_coefficient"},
    {"injection", "inlets"},
    {"injectors", "inlets"},
    {"perforations", "wells"},
    {"position", "at"},
    {"location", "at"},
    {"fracture", "cracks"},
    {"fractures", "cracks"},
    {"notches", "cracks"},
    {"faults", "cracks"},
    {"fracturefluid", "crack_fluid"},
    {"fracturingfluid", "crack_fluid"},
    {"mechanics", "solid"},
    {"rock", "solid"},
    {"elasticity", "solid"},
    {"flow", "pore_flow"},
    {"darcy", "pore_flow"},
    {"domain", "body"},
    {"geometry", "body"},
    {"mesh", "body"},
    {"grid", "body"},
    {"frequency", "interval"},
    {"friction", "crack_friction"},
    {"frictioncoefficient", "crack_friction"},
});

std::string folded(std::string_view written) {
  std::string word;
  for (const char c : written.substr(0, 60)) {
    if (c == '_' || c == '-') continue;
    word += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return word;
}

/// The path of a key of this name in the tree below, the first in the order of declaration.
std::string path_of(std::string_view name, const KeyNode& node, const std::string& path) {
  for (const KeyNode& child : node.children) {
    const std::string below = join_path(path, child.name);
    if (child.name == name) return below;
    if (const std::string found = path_of(name, child, below); !found.empty()) return found;
  }
  return {};
}

}  // namespace

std::string near_key(std::string_view written, const std::vector<std::string>& known) {
  const std::string word = folded(written);
  for (const auto& [other, key] : other_words) {
    if (word == other && std::ranges::count(known, key) > 0) return std::string(key);
  }
  return nearest_name(written, known);
}

std::string expected_key(std::string_view written, const std::vector<std::string>& known,
                         const KeyNode& scene) {
  const std::string near = near_key(written, known);
  const std::string expected =
      known.empty() ? "expected none" : "expected one of: " + list_names(known);
  if (!near.empty()) return fmt::format("{}; did you mean '{}'?", expected, near);
  const std::string word = folded(written);
  std::string elsewhere = path_of(written, scene, "");
  for (const auto& [other, key] : other_words) {
    if (elsewhere.empty() && word == other) elsewhere = path_of(key, scene, "");
  }
  if (elsewhere.empty()) return expected;
  return fmt::format("{}; did you mean '{}'?", expected, elsewhere);
}

}  // namespace perifrac
