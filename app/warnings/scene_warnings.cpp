#include "app/warnings/scene_warnings.hpp"

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/table_reference.hpp"
#include "app/simulation/place_reader.hpp"
#include "app/warnings/nucleus_warning.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

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

/// Points at one wall of so narrow a place see those at the other, and what is left free between
/// points and walls is as much as what they fill.
std::optional<std::string> narrow_fluid_warning(const Section& scene) {
  if (!writes(scene, "fluid.blocks")) return {};
  const double spacing = fluid_spacing(scene);
  const double least = scene.number("fluid.horizon_ratio") * spacing;
  for (std::size_t k = 0; k < scene.count("fluid.blocks"); ++k) {
    const std::string block = fmt::format("fluid.blocks[{}]", k);
    const std::vector<double> from = scene.numbers(block + ".from"),
                              to = scene.numbers(block + ".to");
    for (std::size_t a = 0; a < from.size(); ++a) {
      const double width = to[a] - from[a];
      if (width >= least) continue;
      return fmt::format(
          "{} is {:g} m wide along axis {}, {:.1f} points: it takes more than the fluid's horizon, "
          "{:g} m, for a pressure that does not depend on the spacing; bring points closer "
          "together",
          block, width, "xyz"[a], width / spacing, least);
    }
  }
  return {};
}

}  // namespace

std::vector<std::string> scene_warnings(const Section& scene,
                                        const std::optional<SceneRegime>& regime) {
  std::vector<std::string> warnings = grain_warnings(scene);
  if (regime) warnings.insert(warnings.end(), regime->warnings.begin(), regime->warnings.end());
  if (const auto warning = nucleus_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = narrow_fluid_warning(scene)) warnings.push_back(*warning);
  for (const std::string& warning : table_warnings(scene)) warnings.push_back(warning);
  return warnings;
}

}  // namespace perifrac
