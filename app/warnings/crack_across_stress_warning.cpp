#include "app/warnings/crack_across_stress_warning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "app/warnings/body_box.hpp"
#include "app/warnings/inlet_places.hpp"
#include "app/warnings/stress_on_line.hpp"
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

/// K_II by that shear over K_IC beyond which a crack, once fluid opens it, jumps: at 3 its length
/// is a quarter off by points a sixteenth of it apart, at 1.6 a twelfth.
constexpr double sheared = 2.5;

double distance(const Vector<2>& place, const Vector<2>& from, const Vector<2>& to) {
  const Vector<2> along = to - from;
  const double s = std::clamp(dot(place - from, along) / squared_norm(along), 0.0, 1.0);
  return norm(place - from - s * along);
}

/// Of a crack that may begin at a face, of which it is then one wing [m].
double half_length(const Section& scene, const std::vector<Vector<2>>& corners, double spacing) {
  double length = 0.0;
  for (std::size_t k = 1; k < corners.size(); ++k) length += norm(corners[k] - corners[k - 1]);
  const bool is_wing = std::ranges::any_of(
      std::array{corners.front(), corners.back()},
      [&](const Vector<2>& end) { return distance_to_faces(scene, end) < 0.5 * spacing; });
  return is_wing ? length : 0.5 * length;
}

bool is_pumped(const Section& scene, const std::vector<Vector<2>>& corners, double spacing) {
  return std::ranges::any_of(inlet_places(scene), [&](const std::vector<double>& inlet) {
    for (std::size_t c = 1; c < corners.size(); ++c) {
      if (distance({inlet[0], inlet[1]}, corners[c - 1], corners[c]) < spacing) return true;
    }
    return false;
  });
}

/// Stresses on a crack, compression positive [Pa].
struct CrackStress {
  StressOnLine rock;
  double growing;  ///< what it grows at
  bool is_pumped, has_friction;
};

CrackStress stress_on(const Section& scene, const std::vector<Vector<2>>& corners,
                      const StatedStress& stated) {
  const double spacing = scene.number("body.spacing");
  const double toughness =
      std::sqrt(read_elastic_rock(scene).plane_strain_modulus() * read_fracture_energy(scene));
  return {.rock = stress_on_line(stated, corners.front(), corners.back()),
          .growing = toughness / std::sqrt(M_PI * half_length(scene, corners, spacing)),
          .is_pumped = is_pumped(scene, corners, spacing),
          .has_friction =
              scene.has("solid.crack_friction") && scene.number("solid.crack_friction") > 0.0};
}

std::optional<std::string> warning_of(const CrackStress& on) {
  if (on.rock.shear > sheared * on.growing) {
    const std::string by = fmt::format("by {:.3g} MPa, {:.2g} times what it grows at",
                                       1e-6 * on.rock.shear, on.rock.shear / on.growing);
    if (on.is_pumped) {
      return fmt::format(
          "lies aslant to the stress of the rock, which shears it {}: it jumps where fluid opens "
          "it, and how far depends on body.spacing; lay it along the larger stress, or take one "
          "that is nearer to the lesser",
          by);
    }
    if (!on.has_friction) {
      return fmt::format(
          "is sheared by the stress of the rock, {}, and its faces have no friction: it slides, "
          "and may grow, before any fluid reaches it; give solid.crack_friction",
          by);
    }
  }
  const double more = on.rock.across - on.rock.lengthwise;
  if (!on.is_pumped || on.rock.shear > aslant * more || !(more > (1.0 + unstable) * on.growing)) {
    return {};
  }
  return fmt::format(
      "lies across the larger stress, {:.3g} MPa against {:.3g} MPa along it: in rock it would "
      "turn, and here it goes on as long as nothing disturbs it; lay it along the larger stress",
      1e-6 * on.rock.across, 1e-6 * on.rock.lengthwise);
}

}  // namespace

std::optional<std::string> crack_across_stress_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !scene.has("damage.type")) return {};
  if (scene.text("damage.type") != "energy_release" || !has_elastic_rock(scene)) return {};
  if (!writes(scene, "crack_fluid") || !scene.has("body.spacing")) return {};
  const auto stated = read_stated_stress(scene);
  if (!stated) return {};
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const auto warning = warning_of(stress_on(scene, read_crack_corners(scene, k), *stated));
    if (warning) return fmt::format("cracks[{}] {}", k, *warning);
  }
  return {};
}

}  // namespace perifrac
