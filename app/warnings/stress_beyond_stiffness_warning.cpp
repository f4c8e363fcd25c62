#include "app/warnings/stress_beyond_stiffness_warning.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "app/references/rock.hpp"
#include "app/warnings/small_strains.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

std::optional<std::string> stress_beyond_stiffness_warning(const Section& scene) {
  if (!has_elastic_rock(scene)) return {};
  const auto stated = read_stated_stress(scene);
  if (!stated) return {};
  double largest = 0.0;
  for (const double stress : stated->effective) largest = std::max(largest, std::abs(stress));
  const double modulus = read_elastic_rock(scene).plane_strain_modulus();
  if (largest <= large_strain * modulus) return {};
  return fmt::format(
      "the rock at rest bears {:.4g} MPa, {:.2g} of its plane-strain modulus of {:.4g} MPa, and "
      "the solid is for strains up to {:g}: its answer is off by as much; lower the stress, or "
      "look for a unit that is not meant",
      1e-6 * largest, largest / modulus, 1e-6 * modulus, large_strain);
}

}  // namespace perifrac
