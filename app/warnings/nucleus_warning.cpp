#include "app/warnings/nucleus_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/references/rock.hpp"
#include "modules/solid/fracture/crack_nucleation.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

namespace {

/// Over the body's width: beyond, neither the mean stress nor the energy of a crack in an endless
/// body says what a nucleus takes.
constexpr double longest_nucleus = 0.25;

}  // namespace

std::optional<std::string> nucleus_warning(const Section& scene) {
  if (!scene.has("damage.tensile_strength") || !scene.has("body.size") ||
      !scene.has("body.spacing")) {
    return {};
  }
  if (!has_elastic_rock(scene)) return {};
  const double strength = scene.number("damage.tensile_strength");
  const double modulus =
      read_isotropic_elasticity<2>(scene.at("solid"), "material").plane_strain_modulus();
  const double length = modulus * read_fracture_energy(scene) / (strength * strength);
  const double longest =
      length * std::min(edge_nucleus / least_edge_facets, inner_nucleus / least_inner_facets);
  const std::vector<double> size = scene.numbers("body.size");
  const double room = longest_nucleus * std::ranges::min(size);
  if (edge_nucleus * length > room) {
    return fmt::format(
        "cracks begin {:.2g} m long, which is what damage.tensile_strength and fracture_energy say "
        "of even tension, in a body {:.2g} m wide, where tension is not even over such a length: "
        "when and where they begin is not known; a strength of {:.2g} Pa at least",
        edge_nucleus * length, std::ranges::min(size),
        strength * std::sqrt(edge_nucleus * length / room));
  }
  if (scene.number("body.spacing") <= 1.0001 * longest) return {};
  return fmt::format(
      "body.spacing is too coarse for the rock's length E' Gc / damage.tensile_strength^2 = {:.2g} "
      "m: cracks begin longer than they ought to, and where stress is not uniform under a larger "
      "load; at most {:.2g} m",
      length, longest);
}

}  // namespace perifrac
