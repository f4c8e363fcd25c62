#include "app/warnings/short_leg_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/warnings/body_box.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {

namespace {

/// From the first of the corners to the first at which the path turns sharply; infinite: at none.
double to_sharp_turn(const std::vector<Vector<2>>& corners) {
  const Vector<2> first = corners[1] - corners[0];
  double length = norm(first);
  for (std::size_t k = 2; k < corners.size(); ++k) {
    const Vector<2> leg = corners[k] - corners[k - 1];
    if (is_other_leg(dot(first, leg) / (norm(first) * norm(leg)))) return length;
    length += norm(leg);
  }
  return INFINITY;
}

}  // namespace

std::optional<std::string> short_leg_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !scene.has("damage.type")) return {};
  if (scene.text("damage.type") != "energy_release" || !scene.has("body.spacing")) return {};
  const double spacing = scene.number("body.spacing");
  // On a face a crack has no tip.
  const auto is_open_there = [&](const Vector<2>& place) {
    return distance_to_faces(scene, place) < 0.25 * spacing;
  };
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    for (int end = 0; end < 2; ++end, std::ranges::reverse(corners)) {
      const Vector<2>& place = corners.front();
      const double length = to_sharp_turn(corners);
      if (length >= largest_ring * spacing || is_open_there(place)) continue;
      return fmt::format(
          "cracks[{}] turns sharply {:.2g} spacings before it ends at ({:.6g}, {:.6g}) m: too near "
          "to know when and where to it goes on there; let its last leg be longer, or take a "
          "body.spacing of {:.2g} m or less",
          k, length / spacing, place[0], place[1], length / largest_ring);
    }
  }
  return {};
}

}  // namespace perifrac
