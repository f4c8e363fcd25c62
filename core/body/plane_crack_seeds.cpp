#include "core/body/plane_crack_seeds.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/body/outside.hpp"

namespace perifrac {

namespace {

/// What spans the plane of a normal: along axes where that lies along one.
std::array<Vector<3>, 2> directions(const Section& scene, const std::string& path) {
  const std::vector<double> normal = scene.numbers(path);
  const double size = std::hypot(normal[0], normal[1], normal[2]);
  if (!(size > 0.0)) scene.fail(path, "a direction of no length", "such as [0, 0, 1]");
  const auto least = std::ranges::min_element(normal, {}, [](double n) { return std::abs(n); });
  const auto first = static_cast<std::size_t>(least - normal.begin());
  Vector<3> one{}, other{};
  one[first] = 1.0;
  for (std::size_t a = 0; a < 3; ++a) one[a] -= normal[first] / size * normal[a] / size;
  const double length = std::hypot(one[0], one[1], one[2]);
  for (double& x : one) x /= length;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    other[a] = (normal[b] * one[c] - normal[c] * one[b]) / size;
  }
  return {one, other};
}

/// Whether a square whose middle is so far from the crack's centre belongs to it.
struct Outline {
  double radius = 0.0;
  std::array<double, 2> half{};

  bool contains(double x, double y) const {
    if (radius > 0.0) return std::hypot(x, y) <= radius;
    return std::abs(x) <= half[0] && std::abs(y) <= half[1];
  }
  double reach() const { return std::max({radius, half[0], half[1]}); }
};

Outline read_outline(const Section& scene, const std::string& crack, double spacing) {
  if (scene.has(crack + ".radius") == scene.has(crack + ".sides")) {
    scene.fail(crack, scene.has(crack + ".radius") ? "a radius and sides" : "no radius",
               "either radius or sides");
  }
  Outline outline;
  std::string path = crack + ".radius";
  if (scene.has(path)) {
    outline.radius = scene.number(path);
  } else {
    path = crack + ".sides";
    const std::vector<double> sides = scene.numbers(path);
    if (sides.size() != 2) scene.fail(path, fmt::format("{} numbers", sides.size()), "two lengths");
    outline.half = {0.5 * sides[0], 0.5 * sides[1]};
  }
  constexpr double most = 1e4;
  if (!(outline.reach() >= spacing && outline.reach() <= most * spacing)) {
    scene.fail(path, fmt::format("a crack of {:g} m from its centre", outline.reach()),
               fmt::format("{:g} to {:g} spacings of {:g} m", 1.0, most, spacing));
  }
  return outline;
}

Region<3> box_of(const Body<3>& body) {
  Region<3> box;
  for (int a = 0; a < 3; ++a) {
    const auto [least, largest] = std::ranges::minmax(body.points().position[a]);
    box.from[a] = least - 0.25 * body.spacing();
    box.to[a] = largest + 0.25 * body.spacing();
  }
  return box;
}

/// What lies beyond a face is no part of the crack, where its centre is on that face: a plane of
/// symmetry, or one that it begins at.
bool begins_at(const Body<3>& body, int face, const std::vector<double>& centre) {
  const Face& plane = body.faces()[face];
  return !plane.curved() &&
         std::abs(centre[plane.axis] - plane.coordinate) <= 0.51 * body.spacing();
}

}  // namespace

std::vector<CrackFacet<3>> read_plane_crack(const Section& scene, std::size_t k,
                                            const Body<3>& body) {
  const std::string crack = fmt::format("cracks[{}]", k);
  for (const char* key : {".path", ".file"}) {
    if (scene.has(crack + key)) scene.fail(crack + key, "in 3D", "centre, normal and radius");
  }
  for (const char* key : {".centre", ".normal"}) {
    if (!scene.has(crack + key)) {
      scene.fail(crack, fmt::format("missing key '{}'", key + 1), "three numbers");
    }
  }
  const double spacing = body.spacing();
  const std::vector<double> centre = scene.numbers(crack + ".centre");
  const auto along = directions(scene, crack + ".normal");
  const Outline outline = read_outline(scene, crack, spacing);
  const Region<3> box = box_of(body);
  const int beyond = face_before<3>(body, {centre[0], centre[1], centre[2]});
  if (beyond >= 0 && !body.faces()[beyond].is_hole()) {
    scene.fail(crack + ".centre",
               fmt::format("({:.6g}) m lies outside the body, beyond face '{}'",
                           fmt::join(centre, ", "), body.faces()[beyond].name),
               "a place in the body or on its faces");
  }
  const auto corner = [&](int i, int j) {
    Vector<3> x;
    for (std::size_t a = 0; a < 3; ++a)
      x[a] = centre[a] + spacing * (i * along[0][a] + j * along[1][a]);
    return x;
  };
  const int most = static_cast<int>(std::ceil(outline.reach() / spacing));
  std::vector<CrackFacet<3>> facets;
  for (int i = -most; i < most; ++i) {
    for (int j = -most; j < most; ++j) {
      if (!outline.contains((i + 0.5) * spacing, (j + 0.5) * spacing)) continue;
      const CrackFacet<3> facet = {corner(i, j), corner(i + 1, j), corner(i + 1, j + 1),
                                   corner(i, j + 1)};
      const Vector<3> x = middle<3>(facet);
      const int face = face_before<3>(body, x);
      if (face < 0 && box.contains(x)) facets.push_back(facet);
      if (face < 0 || body.faces()[face].is_hole() || begins_at(body, face, centre)) continue;
      scene.fail(crack,
                 fmt::format("sticks out of the body at ({:.6g}) m, beyond face '{}'",
                             fmt::join(x, ", "), body.faces()[face].name),
                 "a crack in the body, which may begin at a face with its centre there");
    }
  }
  if (facets.empty()) scene.fail(crack, "a crack outside the body", "one that cuts it");
  return facets;
}

}  // namespace perifrac
