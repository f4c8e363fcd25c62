#include "core/geometry/crack_seeds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace perifrac {

KeyTable crack_seed_keys() {
  return {{.path = "cracks[].name",
           .type = KeyType::text,
           .required = true,
           .meaning = "Name of a crack that the body has from the start, a notch or a natural "
                      "fracture."},
          {.path = "cracks[].path",
           .type = KeyType::numbers,
           .unit = "m",
           .required = true,
           .meaning = "The corners of its path, x and y in turn. It cuts every bond that it "
                      "crosses; half-way between two rows of points it is smoothest."}};
}

std::vector<CrackFacet<2>> read_crack_seeds(const Section& scene, double spacing) {
  std::vector<CrackFacet<2>> facets;
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::string path = fmt::format("cracks[{}].path", k);
    const std::vector<double> corners = scene.numbers(path);
    if (corners.size() < 4 || corners.size() % 2 != 0) {
      scene.fail(path, fmt::format("{} numbers", corners.size()), "x and y of two corners or more");
    }
    for (std::size_t leg = 0; leg + 4 <= corners.size(); leg += 2) {
      const Vector<2> from = {corners[leg], corners[leg + 1]};
      const Vector<2> to = {corners[leg + 2], corners[leg + 3]};
      const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
      if (length < 0.5 * spacing) {
        scene.fail(path, fmt::format("a leg of {:g} m", length),
                   fmt::format("legs of a spacing, {:g} m, or more", spacing));
      }
      const int pieces = std::max(1, static_cast<int>(std::lround(length / spacing)));
      Vector<2> last = from;
      for (int piece = 1; piece <= pieces; ++piece) {
        const double share = static_cast<double>(piece) / pieces;
        const Vector<2> next = piece == pieces ? to
                                               : Vector<2>{from[0] + share * (to[0] - from[0]),
                                                           from[1] + share * (to[1] - from[1])};
        facets.push_back({last, next});
        last = next;
      }
    }
  }
  return facets;
}

}  // namespace perifrac
