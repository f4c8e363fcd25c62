#include "app/warnings/body_box.hpp"

#include <algorithm>
#include <cmath>

namespace perifrac {

std::array<std::vector<double>, 2> body_box(const Section& scene) {
  const std::vector<double> size = scene.numbers("body.size");
  std::vector<double> low(size.size(), 0.0);
  if (scene.has("body.from")) low = scene.numbers("body.from");
  std::vector<double> high = low;
  for (std::size_t a = 0; a < size.size(); ++a) high[a] += size[a];
  return {low, high};
}

double distance_to_faces(const Section& scene, std::span<const double> place) {
  double distance = INFINITY;
  if (scene.text("body.shape") != "box") return distance;
  const auto [low, high] = body_box(scene);
  for (std::size_t a = 0; a < place.size(); ++a) {
    distance = std::min({distance, place[a] - low[a], high[a] - place[a]});
  }
  return distance;
}

}  // namespace perifrac
