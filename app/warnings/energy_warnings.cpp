#include "app/warnings/energy_warnings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "app/references/rock.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"
#include "modules/solid/material/stress_at_rest.hpp"

namespace perifrac {

namespace {

constexpr double noticeable = 0.05;

bool is_rigid(const Section& scene) {
  return scene.has("solid") && scene.word("solid.type") == "rigid";
}

/// What the body holds at a strain of 1e-9 all over, or of 1e-4 of what it bears at rest: 1e-8 of
/// the energy of that, of which equilibrium by iteration was seen to leave 3e-9 [J]. In 2D per
/// metre; 0 where nothing strains.
double hardly_any(const Section& scene, const Simulation& simulation) {
  if (!simulation.has_body() || !has_elastic_rock(scene)) return 0.0;
  const double modulus = read_isotropic_elasticity<3>(scene.at("solid"), "material").shear_modulus;
  double strain = 1e-9;
  if (const auto stated = read_stated_stress(scene)) {
    for (const double stress : stated->effective)
      strain = std::max(strain, 1e-4 * std::abs(stress) / modulus);
  }
  return std::visit(
      [&](const auto& body) {
        const auto& volume = body->points().volume;
        return modulus * strain * strain * std::reduce(volume.begin(), volume.end());
      },
      simulation.body);
}

bool is_noticeable(const Section& scene, const Simulation& simulation, double share) {
  const auto energy = simulation.manager->ledger().energy();
  if (!energy || share <= noticeable) return false;
  const double there =
      std::max({std::abs(energy->stored), std::abs(energy->gained), std::abs(energy->dissipated)});
  return there > hardly_any(scene, simulation);
}

}  // namespace

std::optional<std::string> start_warning(const Section& scene, const Simulation& simulation,
                                         double released) {
  // In rock that stays as it is only fluid at the inlets is set free, and soon forgotten.
  if (is_rigid(scene) || !is_noticeable(scene, simulation, released)) return {};
  return fmt::format(
      "what the scene gives at the start is not in balance: {:.0f} % of its energy is set free at "
      "once, and moves nothing; {}a schedule brings on gradually what acts",
      100.0 * released,
      scene.has("pore_flow")
          ? "an initial pressure of the pores wants the stress that bears it, and "
          : "");
}

std::optional<std::string> balance_warning(const Section& scene, const Simulation& simulation) {
  const auto energy = simulation.manager->ledger().energy();
  if (!energy || !is_noticeable(scene, simulation, energy->relative_error)) return {};
  if (simulation.manager->is_unstable()) {  // shorter windows would make it worse
    return fmt::format(
        "the energy balance is {:.0f} % open; leave coupling.split and coupling.iterations out",
        100.0 * energy->relative_error);
  }
  return fmt::format("the energy balance is {:.0f} % open; shorter windows{} may close it",
                     100.0 * energy->relative_error,
                     scene.has("damage")
                         ? ", a finer body.spacing, whose steps of growth are shorter, or a crack "
                           "that does not begin far beyond its criterion"
                         : " or more coupling.iterations");
}

}  // namespace perifrac
