#include "app/warnings/slanted_at_mirror_warning.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "app/warnings/mirrors_at.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

/// Between crack and face. At 45 degrees a half is within 5e-4 of the whole body's pressure, and
/// within 1 % of its opening at the face; at 27 it is 7 % off, and closed there.
constexpr double least_angle = 40.0;

}  // namespace

std::optional<std::string> slanted_at_mirror_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !writes(scene, "solid")) return {};
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    for (int end = 0; end < 2; ++end, std::ranges::reverse(corners)) {
      const std::vector<int> mirrors = mirrors_at(scene, corners.front());
      if (mirrors.empty()) continue;
      const Vector<2> leg = corners[1] - corners[0];
      const double angle =
          180.0 / std::numbers::pi * std::asin(std::abs(leg[mirrors[0] / 2]) / norm(leg));
      if (angle >= least_angle) continue;
      return fmt::format(
          "cracks[{}] begins at {:.0f} degrees to the {} face, which solid.boundary mirrors: from "
          "below {:g} degrees on it is held closed there by bonds to its own image; let it begin "
          "more steeply, or simulate both halves",
          k, angle, face_names<2>()[mirrors[0]], least_angle);
    }
  }
  return {};
}

}  // namespace perifrac
