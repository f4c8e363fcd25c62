#include "app/warnings/crack_across_stress_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/warnings/body_box.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "modules/solid/fracture/damage_keys.hpp"

namespace perifrac {

namespace {

/// Stress along the tip, over what the crack grows at, beyond which a turn grows e^10 times before
/// the crack has doubled its length: 8 T^2 a / K^2 = 8 / pi (T / sigma_c)^2.
constexpr double unstable = 2.0;

/// Shear over the difference of the stresses across and along it beyond which a crack lies aslant,
/// and turns at once.
constexpr double aslant = 0.25;

double distance(const Vector<2>& place, const Vector<2>& from, const Vector<2>& to) {
  const Vector<2> along = to - from;
  const double s = std::clamp(dot(place - from, along) / squared_norm(along), 0.0, 1.0);
  return norm(place - from - s * along);
}

std::vector<Vector<2>> inlets(const Section& scene) {
  std::vector<Vector<2>> places;
  const auto add = [&](const std::string& list) {
    for (std::size_t k = 0; k < scene.count(list); ++k) {
      const std::vector<double> at = scene.numbers(fmt::format("{}[{}].at", list, k));
      places.push_back({at[0], at[1]});
    }
  };
  add("crack_fluid.inlets");
  for (std::size_t k = 0; k < scene.count("crack_fluid.wells"); ++k) {
    add(fmt::format("crack_fluid.wells[{}].clusters", k));
  }
  return places;
}

/// Of the rock at rest at this place, along x and y, compressive positive; pore pressure apart,
/// which is the same in all directions [Pa].
Vector<2> stress_at_rest(const Section& scene, const Vector<2>& place) {
  const bool is_total = writes(scene, "solid.total_stress");
  const auto stress = scene.numbers(is_total ? "solid.total_stress" : "solid.confining_stress");
  Vector<2> there = {stress[0], stress[1]};
  if (!writes(scene, "solid.stress_gradient")) return there;
  const auto gradient = scene.numbers("solid.stress_gradient");
  const double depth = scene.number("solid.stress_datum") - place[1];
  return there + depth * Vector<2>{gradient[0], gradient[1]};
}

/// Of a wing: the crack is whole, or half of one that a face cuts off [m].
double half_length(const Section& scene, const std::vector<Vector<2>>& corners, double spacing) {
  double length = 0.0;
  for (std::size_t k = 1; k < corners.size(); ++k) length += norm(corners[k] - corners[k - 1]);
  if (scene.text("body.shape") != "box") return 0.5 * length;
  const auto [low, high] = body_box(scene);
  for (const Vector<2>& end : {corners.front(), corners.back()}) {
    for (std::size_t a = 0; a < 2; ++a) {
      if (std::min(end[a] - low[a], high[a] - end[a]) < 0.5 * spacing) return length;
    }
  }
  return 0.5 * length;
}

}  // namespace

std::optional<std::string> crack_across_stress_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !scene.has("damage.type")) return {};
  if (scene.text("damage.type") != "energy_release" || !has_elastic_rock(scene)) return {};
  if (!writes(scene, "crack_fluid") || !scene.has("body.spacing")) return {};
  if (!writes(scene, "solid.confining_stress") && !writes(scene, "solid.total_stress")) return {};
  const double spacing = scene.number("body.spacing");
  const double toughness =
      std::sqrt(read_elastic_rock(scene).plane_strain_modulus() * read_fracture_energy(scene));
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    const auto is_in_it = [&](const Vector<2>& place) {
      for (std::size_t c = 1; c < corners.size(); ++c) {
        if (distance(place, corners[c - 1], corners[c]) < spacing) return true;
      }
      return false;
    };
    if (std::ranges::none_of(inlets(scene), is_in_it)) continue;
    const Vector<2> along =
        (corners.back() - corners.front()) / norm(corners.back() - corners.front());
    const Vector<2> stress = stress_at_rest(scene, 0.5 * (corners.front() + corners.back()));
    const double lengthwise = along[0] * along[0] * stress[0] + along[1] * along[1] * stress[1];
    const double across = along[1] * along[1] * stress[0] + along[0] * along[0] * stress[1];
    const double shear = std::abs(along[0] * along[1] * (stress[0] - stress[1]));
    const double growing = toughness / std::sqrt(M_PI * half_length(scene, corners, spacing));
    if (across - lengthwise <= (1.0 + unstable) * growing) continue;
    if (shear > aslant * (across - lengthwise)) continue;
    return fmt::format(
        "cracks[{}] lies across the larger stress, {:.3g} MPa against {:.3g} MPa along it: in rock "
        "it would turn, and here it goes on as long as nothing disturbs it; lay it along the "
        "larger "
        "stress",
        k, 1e-6 * across, 1e-6 * lengthwise);
  }
  return {};
}

}  // namespace perifrac
