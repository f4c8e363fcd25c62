#include "app/scene_warnings.hpp"

#include <fmt/format.h>

#include "app/nucleus_warning.hpp"
#include "app/references/comparison.hpp"
#include "app/references/table_reference.hpp"
#include "modules/solid/isotropic_elasticity.hpp"

namespace perifrac {

namespace {

/// What a region says of a key of its physics, or else the physics itself.
std::string in_region(const Section& scene, const std::string& physics, const std::string& region,
                      const std::string& key) {
  const std::string there = fmt::format("{}.regions.{}.{}", physics, region, key);
  return !region.empty() && writes(scene, there) ? there : physics + "." + key;
}

/// Pores make rock softer than its grains are; a Biot coefficient below 1 - K / K_s is another
/// rock.
std::optional<std::string> grain_warning(const Section& scene, const std::string& region) {
  const std::string grains = in_region(scene, "pore_flow", region, "grain_bulk_modulus");
  if (!writes(scene, grains)) return {};
  const std::string material = in_region(scene, "solid", region, "material");
  const auto rock = read_isotropic_elasticity<3>(scene, material);
  const double drained = rock.drained_bulk_modulus();
  if (drained <= scene.number(grains)) return {};
  return fmt::format(
      "the drained bulk modulus of the rock, {:.3g} Pa, is above that of its grains, {} = {:.3g} "
      "Pa: no rock is like that; lower {} or raise the grains'",
      drained, grains, scene.number(grains), material);
}

std::vector<std::string> grain_warnings(const Section& scene) {
  if (!writes(scene, "pore_flow") || !writes(scene, "solid.material")) return {};
  std::vector<std::string> regions = {""};
  for (const char* const physics : {"pore_flow.regions", "solid.regions"}) {
    if (!writes(scene, physics)) continue;
    for (const std::string& name : scene.names(physics)) regions.push_back(name);
  }
  for (const std::string& region : regions) {
    if (const auto warning = grain_warning(scene, region)) return {*warning};
  }
  return {};
}

}  // namespace

std::vector<std::string> scene_warnings(const Section& scene,
                                        const std::optional<SceneRegime>& regime) {
  std::vector<std::string> warnings = grain_warnings(scene);
  if (regime) warnings.insert(warnings.end(), regime->warnings.begin(), regime->warnings.end());
  if (const auto warning = nucleus_warning(scene)) warnings.push_back(*warning);
  for (const std::string& warning : table_warnings(scene)) warnings.push_back(warning);
  return warnings;
}

}  // namespace perifrac
