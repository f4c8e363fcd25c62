#include "core/body/crack_seeds.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/geometry/cloud_file.hpp"

namespace perifrac {

KeyTable crack_seed_keys() {
  return {
      {.path = "cracks[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a crack that the body has from the start, a notch or a natural "
                  "fracture."},
      {.path = "cracks[].path",
       .type = KeyType::numbers,
       .unit = "m",
       .meaning = "In 2D: the corners of its path, x and y in turn. It cuts every bond that it "
                  "crosses; half-way between two rows of points it is smoothest."},
      {.path = "cracks[].file",
       .type = KeyType::text,
       .meaning = "In place of path: a file with its corners in m, a first line `x,y` and then "
                  "a line a corner; taken from the folder of the scene."},
      {.path = "cracks[].centre",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "In 3D: the middle of a plane crack, where four of its squares meet; best "
                  "half-way between rows of points in all directions."},
      {.path = "cracks[].normal", .type = KeyType::vector, .meaning = "In 3D: across its plane."},
      {.path = "cracks[].radius", .unit = "m", .range = "(0, inf)", .meaning = "In 3D: of a disc."},
      {.path = "cracks[].sides",
       .type = KeyType::numbers,
       .unit = "m",
       .meaning = "In 3D, in place of radius: the two sides of a rectangle."},
      {.path = "cracks[].opening",
       .unit = "m",
       .range = "[0, inf)",
       .fallback = "0 m",
       .meaning = "Its width beside a rigid solid, which stays; a solid that deforms says "
                  "itself how wide its cracks are."}};
}

bool has_cracks(const Section& scene) { return scene.has("damage") || scene.count("cracks") > 0; }

std::vector<Vector<2>> read_crack_corners(const Section& scene, std::size_t k) {
  const std::string crack = fmt::format("cracks[{}]", k);
  for (const char* key : {".centre", ".normal", ".radius", ".sides"}) {
    if (scene.has(crack + key)) scene.fail(crack + key, "in 2D", "a path");
  }
  const bool from_file = scene.has(crack + ".file");
  if (scene.has(crack + ".path") == from_file) {
    scene.fail(crack, from_file ? "a path and a file" : "no path", "either path or file");
  }
  std::vector<Vector<2>> corners;
  if (from_file) {
    const Points<2> points = read_cloud<2>(scene.file(crack + ".file")).points;
    for (Index i = 0; i < points.size(); ++i) corners.push_back(points.at(i));
    if (corners.size() < 2) scene.fail(crack + ".file", "one corner", "two corners or more");
    return corners;
  }
  const std::vector<double> x = scene.numbers(crack + ".path");
  if (x.size() < 4 || x.size() % 2 != 0) {
    scene.fail(crack + ".path", fmt::format("{} numbers", x.size()),
               "x and y of two corners or more");
  }
  for (std::size_t n = 0; n < x.size(); n += 2) corners.push_back({x[n], x[n + 1]});
  return corners;
}

std::vector<CrackFacet<2>> read_crack(const Section& scene, std::size_t k, double spacing) {
  std::vector<CrackFacet<2>> facets;
  const std::string crack = fmt::format("cracks[{}]", k);
  const std::string path = crack + (scene.has(crack + ".file") ? ".file" : ".path");
  const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
  for (std::size_t leg = 0; leg + 1 < corners.size(); ++leg) {
    const Vector<2>& from = corners[leg];
    const Vector<2>& to = corners[leg + 1];
    const double length = std::hypot(to[0] - from[0], to[1] - from[1]);
    if (length < 0.5 * spacing) {
      scene.fail(path, fmt::format("a leg of {:g} m", length),
                 fmt::format("legs of a spacing, {:g} m, or more", spacing));
    }
    constexpr double most_pieces = 1e6;
    if (!(length <= most_pieces * spacing)) {
      scene.fail(
          path, fmt::format("a leg of {:g} m", length),
          fmt::format("legs of at most {:g} spacings, {:g} m", most_pieces, most_pieces * spacing));
    }
    const int pieces = std::max(1, static_cast<int>(std::lround(length / spacing)));
    constexpr std::size_t most_facets = 20000;  // each answers to each: more fit into no memory
    if (facets.size() + pieces > most_facets) {
      scene.fail(path, fmt::format("more than {} spacings of crack", most_facets),
                 fmt::format("at most {:g} m", most_facets * spacing));
    }
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
  return facets;
}

}  // namespace perifrac
