#include "app/warnings/crack_along_face_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/warnings/body_box.hpp"
#include "app/warnings/mirrors_at.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

/// In spacings. Along rock of three a crack that fluid drives is a sixth too wide, and took half as
/// much energy again; along rock of four and five a twentieth too wide or two.
constexpr double least_thick = 3.5;
/// Of its thickness: what is shorter does not bend.
constexpr double least_long = 2.0;
/// Cosine of the angle between a crack and a face that it runs along: of 14 degrees.
constexpr double least_along = 0.97;

/// Of the leg of a crack: what lies less than `near` from a face [m].
struct Stretch {
  double length = 0.0;
  double thickness = 0.0;  ///< of the rock between, in the mean
};

Stretch near_face(const Vector<2>& from, const Vector<2>& to, int face, double at, double near) {
  const int axis = face / 2;
  const double length = norm(to - from);
  if (std::abs((to - from)[1 - axis]) < least_along * length) return {};
  const auto [least, most] = std::minmax({std::abs(from[axis] - at), std::abs(to[axis] - at)});
  if (least >= near) return {};
  const double part = most <= near ? 1.0 : (near - least) / (most - least);
  return {.length = part * length, .thickness = 0.5 * (least + std::min(most, near))};
}

}  // namespace

std::optional<std::string> crack_along_face_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !writes(scene, "solid")) return {};
  if (scene.text("body.shape") != "box" || !scene.has("body.spacing")) return {};
  const double spacing = scene.number("body.spacing");
  const auto [low, high] = body_box(scene);
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    for (int face = 0; face < 4; ++face) {
      const double at = (face % 2 == 0 ? low : high)[face / 2];
      Vector<2> on_face = corners[0];
      on_face[face / 2] = at;
      if (std::ranges::count(mirrors_at(scene, on_face), face) > 0) continue;
      for (std::size_t c = 1; c < corners.size(); ++c) {
        const Stretch stretch =
            near_face(corners[c - 1], corners[c], face, at, least_thick * spacing);
        if (!(stretch.length > least_long * stretch.thickness)) continue;
        return fmt::format(
            "cracks[{}] runs along the {} face for {:.2g} m, {:.1f} spacings from it: rock of so "
            "few points bends too easily; a finer body.spacing",
            k, face_names<2>()[face], stretch.length, stretch.thickness / spacing);
      }
    }
  }
  return {};
}

}  // namespace perifrac
