#include "app/warnings/slip_at_rest_warning.hpp"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "app/warnings/stress_on_line.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/geometry/region.hpp"

namespace perifrac {

namespace {

/// Of the limit; less is rounding in what a scene says.
constexpr double beyond = 1.001;

/// Pressure of the fluid that a crack has at a place at the start; 0 where it is dry [Pa].
double pressure_at_start(const Section& scene, const Vector<2>& place) {
  for (std::size_t k = 0; k < scene.count("crack_fluid.filled"); ++k) {
    const std::string box = fmt::format("crack_fluid.filled[{}]", k);
    Region<2> where;
    std::ranges::copy(scene.numbers(box + ".from"), where.from.begin());
    std::ranges::copy(scene.numbers(box + ".to"), where.to.begin());
    if (where.contains(place)) return scene.number(box + ".pressure");
  }
  return 0.0;
}

}  // namespace

std::optional<std::string> slip_at_rest_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !scene.has("solid.crack_friction")) return {};
  const double friction = scene.number("solid.crack_friction");
  const auto stated = read_stated_stress(scene);
  if (!stated || !(friction > 0.0)) return {};
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    for (std::size_t c = 1; c < corners.size(); ++c) {
      const StressOnLine faces = stress_on_line(*stated, corners[c - 1], corners[c]);
      const double fluid = pressure_at_start(scene, 0.5 * (corners[c - 1] + corners[c]));
      const double limit = friction * std::max(0.0, faces.across - fluid);
      if (!(faces.shear > beyond * limit)) continue;
      return fmt::format(
          "cracks[{}] bears {:.3g} MPa of shear at rest, and friction of {:.3g} holds {:.3g}: what "
          "is too much goes into slip at once; raise solid.crack_friction, or bring the stresses "
          "at rest nearer to each other",
          k, 1e-6 * faces.shear, friction, 1e-6 * limit);
    }
  }
  return {};
}

}  // namespace perifrac
