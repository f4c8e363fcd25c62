#include "app/warnings/slanted_at_mirror_warning.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/warnings/body_box.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

/// Between crack and face. At 45 degrees a half is within 5e-4 of the whole body's pressure, and
/// within 1 % of its opening at the face; at 27 it is 7 % off, and closed there.
constexpr double least_angle = 40.0;

bool is_mirrored(const Section& scene, const std::string& face) {
  const std::string path = "solid.boundary." + face;
  if (!scene.has(path + ".type")) return false;
  if (is_layer(scene, face)) return false;
  return std::ranges::count(std::array{"roller", "fixed", "rigid_plate"},
                            scene.text(path + ".type")) > 0;
}

/// Of the face that this place lies on and the solid mirrors; nothing: of none.
std::optional<int> mirror_at(const Section& scene, const Vector<2>& place) {
  const auto [low, high] = body_box(scene);
  const double rounding = 0.25 * scene.number("body.spacing");
  for (int f = 0; f < 4; ++f) {
    const double face = (f % 2 == 0 ? low : high)[f / 2];
    if (std::abs(place[f / 2] - face) > rounding) continue;
    if (is_mirrored(scene, face_names<2>()[f])) return f;
  }
  return {};
}

}  // namespace

std::optional<std::string> slanted_at_mirror_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !writes(scene, "solid")) return {};
  if (scene.text("body.shape") != "box" || !scene.has("body.spacing")) return {};
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    for (int end = 0; end < 2; ++end, std::ranges::reverse(corners)) {
      const auto face = mirror_at(scene, corners.front());
      if (!face) continue;
      const Vector<2> leg = corners[1] - corners[0];
      const double angle =
          180.0 / std::numbers::pi * std::asin(std::abs(leg[*face / 2]) / norm(leg));
      if (angle >= least_angle) continue;
      return fmt::format(
          "cracks[{}] begins at {:.0f} degrees to the {} face, which solid.boundary mirrors: from "
          "below {:g} degrees on it is held closed there by bonds to its own image; let it begin "
          "more steeply, or simulate both halves",
          k, angle, face_names<2>()[*face], least_angle);
    }
  }
  return {};
}

}  // namespace perifrac
