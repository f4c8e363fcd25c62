#include "app/warnings/light_solid_warning.hpp"

#include <cmath>

#include <fmt/format.h>

#include "app/references/comparison.hpp"

namespace perifrac {

namespace {

/// Mass of fluid over mass of the outermost points, by area. Water on a plate: at 1.8 energies are
/// 3 % off, at 3.5 displacements by a third, at 19 the plate flies apart.
constexpr double heaviest = 2.0;

}  // namespace

std::optional<std::string> light_solid_warning(const Section& scene) {
  if (!writes(scene, "fluid") || !writes(scene, "solid")) return {};
  if (scene.text("solid.type") != "dynamic" || writes(scene, "coupling.iterations")) return {};
  if (!writes(scene, "coupling.window.largest") || !writes(scene, "body.spacing")) return {};
  const double density = scene.number("fluid.density");
  const double impedance = std::sqrt(scene.number("fluid.bulk_modulus") * density);
  const double window = scene.number("coupling.window.largest");
  const double own = scene.number("solid.density") * scene.number("body.spacing");
  if (impedance * window <= heaviest * own) return {};
  return fmt::format(
      "sound meets {:.3g} kg/m^2 of fluid in a window of {:.3g} s, and the solid's outermost "
      "points have {:.3g}: solid and fluid answer each other too late, and may swing apart; take "
      "a coupling.window.largest of {:.2g} s or less",
      impedance * window, window, own, own / impedance);
}

}  // namespace perifrac
