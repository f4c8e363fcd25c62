#include "app/warnings/nucleus_warning.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/references/rock.hpp"
#include "modules/solid/fracture/crack_nucleation.hpp"
#include "modules/solid/fracture/damage_keys.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

std::optional<std::string> nucleus_warning(const Section& scene) {
  if (!scene.has("damage.tensile_strength") || !scene.has("body.spacing")) return {};
  if (!has_elastic_rock(scene)) return {};
  const double strength = scene.number("damage.tensile_strength");
  const double modulus =
      read_isotropic_elasticity<2>(scene.at("solid"), "material").plane_strain_modulus();
  const double length = modulus * read_fracture_energy(scene) / (strength * strength);
  const double longest =
      length * std::min(edge_nucleus / least_edge_facets, inner_nucleus / least_inner_facets);
  if (scene.number("body.spacing") <= 1.0001 * longest) return {};
  return fmt::format(
      "body.spacing is too coarse for the rock's length E' Gc / damage.tensile_strength^2 = {:.2g} "
      "m: cracks begin longer than they ought to, and where stress is not uniform under a larger "
      "load; at most {:.2g} m",
      length, longest);
}

}  // namespace perifrac
