#include "modules/solid/material/material.hpp"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "core/geometry/region.hpp"
#include "core/geometry/scatter.hpp"
#include "modules/solid/material/corotational_elasticity.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/lps_elasticity.hpp"
#include "modules/solid/material/material_type.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

KeyTable material_keys() {
  std::vector<std::string> words;
  std::string meaning;
  for (const MaterialType& type : material_types()) {
    words.push_back(type.name);
    meaning += (meaning.empty() ? "" : "; ") + type.name + ": " + type.meaning;
  }
  KeyTable keys = {
      {.path = "kinematics",
       .type = KeyType::word,
       .fallback = "small",
       .words = {"small", "corotational"},
       .meaning = "small: strains and rotations are small; corotational: strains are small beside "
                  "rotations of any size (dynamic, linear_exact)."},
      {.path = "material.type",
       .type = KeyType::word,
       .fallback = "linear_exact",
       .words = words,
       .meaning = meaning + "."}};
  for (Key& key : stress_at_rest_keys()) keys.push_back(std::move(key));
  for (Key key : elastic_constant_keys()) {
    keys.push_back(key);
    key.path = "regions.*." + key.path;
    key.meaning = "The same in a region of the body, where two constants take the others' place.";
    keys.push_back(key);
  }
  for (const MaterialType& type : material_types()) {
    for (Key& key : keys_of(type)) keys.push_back(std::move(key));
  }
  for (Key& key : scatter_keys("material.scatter", "the stiffness, Poisson's ratio apart,")) {
    keys.push_back(std::move(key));
  }
  return keys;
}

namespace {

template <int D>
LawByRegion<IsotropicElasticity<D>> read_laws(const Section& section, const Body<D>& body) {
  LawByRegion<IsotropicElasticity<D>> law{
      {read_isotropic_elasticity<D>(section, "material")},
      region_of_points<D>(section, body.regions(), body.points())};
  for (const std::string& name : section.names("regions")) {
    const std::string path = "regions." + name + ".material";
    law.laws.push_back(section.has(path) ? read_isotropic_elasticity<D>(section, path)
                                         : law.laws.front());
  }
  const auto scatter = read_scatter<D>(section, "material.scatter");
  if (!scatter) return law;
  return scattered(law, *scatter, body.points(), [](IsotropicElasticity<D> rock, double factor) {
    rock.lame_lambda *= factor;
    rock.shear_modulus *= factor;
    return rock;
  });
}

/// What Eq 3 makes of a rock as it is printed: K - mu/3 where plane strain has K + mu/3.
template <int D>
void misprint(const Section& section, LawByRegion<IsotropicElasticity<D>>& laws) {
  const char* const key = "material.type";
  if (D == 3) {
    section.fail(key, "'lps_printed' in 3D", "lps, which has nothing to correct there but a sign");
  }
  for (auto& law : laws.laws) {
    law.lame_lambda -= 2.0 / 3.0 * law.shear_modulus;
    const double modulus = law.drained_bulk_modulus();
    if (modulus > 0.0) continue;
    section.fail(key, fmt::format("'lps_printed' of a rock with K - mu/3 = {:g} Pa", modulus),
                 "lps, or a larger bulk modulus");
  }
}

template <int D>
std::unique_ptr<BreakableElasticity<D>> make_linear_exact(std::shared_ptr<const Family<D>> family,
                                                          const MirrorCondition<D, D>& mirror,
                                                          LawByRegion<IsotropicElasticity<D>> law,
                                                          std::optional<Vector<D>> initial_stress,
                                                          bool turns) {
  const auto make = [&](auto any_law) -> std::unique_ptr<BreakableElasticity<D>> {
    using Law = decltype(any_law);
    LinearExactOperator<D, Law> op(family, mirror, std::move(any_law));
    if (turns) return std::make_unique<CorotationalElasticity<D, Law>>(std::move(op));
    return std::make_unique<LinearExactElasticity<D, Law>>(std::move(op), initial_stress);
  };
  return law.laws.size() == 1 ? make(law.laws.front()) : make(std::move(law));
}

template <int D>
std::unique_ptr<ElasticOperator<D>> make_linear_exact_type(const MaterialParts<D>& parts) {
  return make_linear_exact<D>(parts.family, parts.mirror, parts.rock, parts.initial_stress,
                              is_corotational(parts.section));
}

template <int D, bool printed>
std::unique_ptr<ElasticOperator<D>> make_lps_type(const MaterialParts<D>& parts) {
  LawByRegion<IsotropicElasticity<D>> law = parts.rock;
  if (printed) misprint(parts.section, law);
  return std::make_unique<LpsElasticity<D>>(parts.family, parts.mirror, std::move(law),
                                            parts.initial_stress, printed ? -1.0 : 1.0);
}

std::vector<MaterialType>& all_materials() {
  static std::vector<MaterialType> types = {
      {.name = "linear_exact",
       .meaning = "isotropic, exact for linear fields on any points",
       .make_2d = make_linear_exact_type<2>,
       .make_3d = make_linear_exact_type<3>},
      {.name = "lps",
       .meaning = "the linear peridynamic solid, whose moduli on a lattice are off "
                  "(docs/materials.md)",
       .make_2d = make_lps_type<2, false>,
       .make_3d = make_lps_type<3, false>},
      {.name = "lps_printed",
       .meaning = "the same with the paper's misprints, 2D, for comparison only",
       .make_2d = make_lps_type<2, true>,
       .make_3d = make_lps_type<3, true>}};
  return types;
}

const MaterialType& type_named(const std::string& name) {
  return *std::ranges::find(material_types(), name, &MaterialType::name);
}

}  // namespace

const std::vector<MaterialType>& material_types() { return all_materials(); }

void add_material_type(MaterialType type) { all_materials().push_back(std::move(type)); }

KeyTable keys_of(const MaterialType& type) {
  KeyTable keys = type.keys;
  for (Key& key : keys) {
    key.path = "material." + key.path;
    if (key.when.empty()) key.when = "type=" + type.name;
  }
  return keys;
}

bool is_linear_material(const Section& section) {
  return type_named(section.word("material.type")).is_linear;
}

bool is_corotational(const Section& section) {
  return section.word("kinematics") == "corotational";
}

template <int D>
std::unique_ptr<ElasticOperator<D>> read_material(const Section& section, const Body<D>& body,
                                                  const SolidBoundary<D>& boundary) {
  const auto family = body.family(boundary.mirrored());
  const auto mirror = boundary.mirror_condition(*family);
  const auto initial_stress = read_uniform_stress<D>(section);
  const MaterialParts<D> parts{section, family, mirror, read_laws<D>(section, body),
                               initial_stress};
  const MaterialType& type = type_named(section.word("material.type"));
  if constexpr (D == 2) {
    return type.make_2d(parts);
  } else {
    return type.make_3d(parts);
  }
}

template <int D>
std::unique_ptr<BreakableElasticity<D>> read_breakable_material(
    const Section& section, const Body<D>& body, std::shared_ptr<const Family<D>> family,
    const MirrorCondition<D, D>& mirror) {
  LawByRegion<IsotropicElasticity<D>> law = read_laws<D>(section, body);
  const std::string type = section.word("material.type");
  if (D == 2 && type == "lps") {
    return std::make_unique<LpsElasticity<D>>(family, mirror, std::move(law));
  }
  if (type != "linear_exact") {
    section.fail("material.type", fmt::format("'{}' beside cracks", type),
                 D == 2 ? "linear_exact or lps" : "linear_exact");
  }
  return make_linear_exact<D>(std::move(family), mirror, std::move(law), {},
                              is_corotational(section));
}

template std::unique_ptr<BreakableElasticity<2>> read_breakable_material<2>(
    const Section&, const Body<2>&, std::shared_ptr<const Family<2>>, const MirrorCondition<2, 2>&);
template std::unique_ptr<BreakableElasticity<3>> read_breakable_material<3>(
    const Section&, const Body<3>&, std::shared_ptr<const Family<3>>, const MirrorCondition<3, 3>&);
template std::unique_ptr<ElasticOperator<2>> read_material<2>(const Section&, const Body<2>&,
                                                              const SolidBoundary<2>&);
template std::unique_ptr<ElasticOperator<3>> read_material<3>(const Section&, const Body<3>&,
                                                              const SolidBoundary<3>&);

}  // namespace perifrac
