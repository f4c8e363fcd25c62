#include "app/warnings/probe_at_tip_warning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/warnings/body_box.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"

namespace perifrac {

namespace {

/// [spacings]: stresses are a fifth off within them, and 8 % half a spacing farther.
constexpr double least_distance = 2.0;

bool reads_cracks(const Section& scene, const std::string& probe) {
  return scene.has(probe + ".field") && scene.text(probe + ".field").starts_with("crack_");
}

/// Ends at a face of the body are mouths.
double distance_to_ends(const Section& scene, std::size_t crack, const std::vector<double>& place) {
  double least = std::numeric_limits<double>::infinity();
  const std::vector<Vector<2>> corners = read_crack_corners(scene, crack);
  for (const Vector<2>& end : {corners.front(), corners.back()}) {
    if (distance_to_faces(scene, end) < 0.5 * scene.number("body.spacing")) continue;
    least = std::min(least, std::hypot(place[0] - end[0], place[1] - end[1]));
  }
  return least;
}

double distance_to_rim(const Section& scene, const std::string& crack,
                       const std::vector<double>& place) {
  const std::vector<double> centre = scene.numbers(crack + ".centre");
  const std::vector<double> normal = scene.numbers(crack + ".normal");
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  double above = 0.0, square = 0.0;
  for (int a = 0; a < 3; ++a) {
    above += (place[a] - centre[a]) * normal[a] / length;
    square += (place[a] - centre[a]) * (place[a] - centre[a]);
  }
  const double aside = std::sqrt(std::max(0.0, square - above * above));
  return std::hypot(above, aside - scene.number(crack + ".radius"));
}

}  // namespace

std::optional<std::string> probe_at_tip_warning(const Section& scene) {
  if (!has_elastic_rock(scene) || !scene.has("body.spacing")) return {};
  const double spacing = scene.number("body.spacing");
  for (std::size_t n = 0; n < scene.count("output.probes"); ++n) {
    const std::string probe = fmt::format("output.probes[{}]", n);
    if (reads_cracks(scene, probe)) continue;
    const std::vector<double> place = scene.numbers(probe + ".at");
    for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
      const std::string crack = fmt::format("cracks[{}]", k);
      double distance = std::numeric_limits<double>::infinity();
      if (scene.integer("dimension") == 2) {
        distance = distance_to_ends(scene, k, place);
      } else if (scene.has(crack + ".radius")) {
        distance = distance_to_rim(scene, crack, place);
      }
      if (!(distance < least_distance * spacing)) continue;
      return fmt::format(
          "probe '{}' lies {:.2g} spacings from the end of {}: displacement and stress vary "
          "there as points resolve them; probe a horizon away, or bring points closer together",
          scene.text(probe + ".name"), distance / spacing, crack);
    }
  }
  return {};
}

}  // namespace perifrac
