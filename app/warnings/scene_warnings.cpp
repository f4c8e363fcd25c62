#include "app/warnings/scene_warnings.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/references/table_reference.hpp"
#include "app/simulation/place_reader.hpp"
#include "app/warnings/crack_across_stress_warning.hpp"
#include "app/warnings/crack_along_face_warning.hpp"
#include "app/warnings/inlet_room_warning.hpp"
#include "app/warnings/light_solid_warning.hpp"
#include "app/warnings/meeting_tips_warning.hpp"
#include "app/warnings/nucleus_warning.hpp"
#include "app/warnings/probe_at_tip_warning.hpp"
#include "app/warnings/sharp_wave_warning.hpp"
#include "app/warnings/short_leg_warning.hpp"
#include "app/warnings/slanted_at_mirror_warning.hpp"
#include "app/warnings/slip_at_rest_warning.hpp"
#include "app/warnings/stress_beyond_stiffness_warning.hpp"
#include "app/warnings/swinging_beam_warning.hpp"
#include "app/warnings/thin_body_warning.hpp"
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
  if (!writes(scene, "pore_flow") || !has_elastic_rock(scene)) return {};
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

/// lambda + 2 mu and mu, of a material that is there [Pa].
std::array<double, 2> stiffness(const Section& scene, const std::string& path) {
  const auto rock = read_isotropic_elasticity<3>(scene, path);
  return {rock.lame_lambda + 2.0 * rock.shear_modulus, rock.shear_modulus};
}

/// How far a place is from the nearest side of a box that the scene gives [m]; infinite where none
/// lies beside it.
double distance_to_sides(const Section& scene, const std::string& box,
                         const std::vector<double>& place, double reach) {
  const auto corner = [&](const char* name, double none) {
    const std::string path = box + "." + name;
    if (!writes(scene, path)) return std::vector<double>(place.size(), none);
    return scene.numbers(path);
  };
  constexpr double far = std::numeric_limits<double>::infinity();
  const std::vector<double> from = corner("from", -far), to = corner("to", far);
  double least = far;
  for (std::size_t a = 0; a < place.size(); ++a) {
    bool is_beside = true;
    for (std::size_t b = 0; b < place.size(); ++b) {
      is_beside = is_beside && (b == a || (place[b] > from[b] - reach && place[b] < to[b] + reach));
    }
    if (!is_beside) continue;
    least = std::min({least, std::abs(place[a] - from[a]), std::abs(place[a] - to[a])});
  }
  return least;
}

/// At the border of rocks that differ so much stresses are of first order in the spacing.
constexpr double telling_contrast = 4.0;

/// A probe beside such a border.
std::optional<std::string> border_warning(const Section& scene) {
  if (!writes(scene, "solid.regions") || !writes(scene, "body.spacing")) return {};
  if (!has_elastic_rock(scene)) return {};
  const double horizon = scene.number("body.horizon_ratio") * scene.number("body.spacing");
  for (const std::string& region : scene.names("solid.regions")) {
    const std::string material = fmt::format("solid.regions.{}.material", region);
    if (!writes(scene, material)) continue;
    const auto here = stiffness(scene, material), elsewhere = stiffness(scene, "solid.material");
    double contrast = 1.0;
    for (const int k : {0, 1}) {
      contrast = std::max({contrast, here[k] / elsewhere[k], elsewhere[k] / here[k]});
    }
    if (contrast < telling_contrast) continue;
    for (std::size_t n = 0; n < scene.count("output.probes"); ++n) {
      const std::string probe = fmt::format("output.probes[{}]", n);
      const double distance =
          distance_to_sides(scene, "body.regions." + region, scene.numbers(probe + ".at"), horizon);
      if (!(distance < horizon)) continue;
      return fmt::format(
          "probe '{}' lies {:.3g} m from the border of region '{}', across which the stiffness "
          "changes {:.2g} times: within a horizon of it, {:.3g} m, stresses are of first order in "
          "body.spacing; probe farther away, or bring points closer together",
          scene.text(probe + ".name"), distance, region, contrast, horizon);
    }
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
  if (const auto warning = meeting_tips_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = short_leg_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = stress_beyond_stiffness_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = slanted_at_mirror_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = slip_at_rest_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = crack_across_stress_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = crack_along_face_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = light_solid_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = narrow_fluid_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = inlet_room_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = border_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = probe_at_tip_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = sharp_wave_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = swinging_beam_warning(scene)) warnings.push_back(*warning);
  if (const auto warning = thin_body_warning(scene)) warnings.push_back(*warning);
  for (const std::string& warning : table_warnings(scene)) warnings.push_back(warning);
  return warnings;
}

}  // namespace perifrac
