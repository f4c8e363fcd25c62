#include "app/warnings/mirrors_at.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "app/references/comparison.hpp"
#include "app/warnings/body_box.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

bool is_mirrored(const Section& scene, const std::string& face) {
  const std::string path = "solid.boundary." + face;
  if (!scene.has(path + ".type")) return false;
  if (is_layer(scene, face)) return false;
  return std::ranges::count(std::array{"roller", "fixed", "rigid_plate"},
                            scene.text(path + ".type")) > 0;
}

}  // namespace

std::vector<int> mirrors_at(const Section& scene, std::span<const double> place) {
  if (scene.text("body.shape") != "box" || !scene.has("body.spacing")) return {};
  const auto [low, high] = body_box(scene);
  const double rounding = 0.25 * scene.number("body.spacing");
  const auto names = place.size() == 2 ? face_names<2>() : face_names<3>();
  std::vector<int> mirrors;
  for (int f = 0; f < 2 * static_cast<int>(place.size()); ++f) {
    const double face = (f % 2 == 0 ? low : high)[f / 2];
    if (std::abs(place[f / 2] - face) > rounding) continue;
    if (is_mirrored(scene, names[f])) mirrors.push_back(f);
  }
  return mirrors;
}

}  // namespace perifrac
