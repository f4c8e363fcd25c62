#include "app/warnings/meeting_tips_warning.hpp"

#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/warnings/body_box.hpp"
#include "core/base/small_vector.hpp"
#include "core/body/crack_seeds.hpp"
#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {

namespace {

struct End {
  std::size_t crack;
  Vector<2> place;      ///< [m]
  Vector<2> direction;  ///< ahead
};

std::vector<End> ends_of_cracks(const Section& scene) {
  std::vector<End> ends;
  for (std::size_t k = 0; k < scene.count("cracks"); ++k) {
    const std::vector<Vector<2>> corners = read_crack_corners(scene, k);
    const auto add = [&](const Vector<2>& place, const Vector<2>& before) {
      const Vector<2> along = place - before;
      ends.push_back({k, place, along / norm(along)});
    };
    add(corners.front(), corners[1]);
    add(corners.back(), corners[corners.size() - 2]);
  }
  return ends;
}

/// Along x and y, on rollers: of a box [m].
std::array<std::vector<double>, 2> planes_of_symmetry(const Section& scene) {
  std::array<std::vector<double>, 2> planes;
  if (scene.text("body.shape") != "box") return planes;
  const auto [low, high] = body_box(scene);
  const std::array<std::array<const char*, 2>, 2> faces = {{{"left", "right"}, {"bottom", "top"}}};
  for (int a = 0; a < 2; ++a) {
    for (int side = 0; side < 2; ++side) {
      const std::string type = fmt::format("solid.boundary.{}.type", faces[a][side]);
      if (scene.has(type) && scene.text(type) == "roller")
        planes[a].push_back(side == 0 ? low[a] : high[a]);
    }
  }
  return planes;
}

}  // namespace

std::optional<std::string> meeting_tips_warning(const Section& scene) {
  if (scene.integer("dimension") != 2 || !scene.has("damage.type")) return {};
  if (scene.text("damage.type") != "energy_release" || !scene.has("body.spacing")) return {};
  const double spacing = scene.number("body.spacing");
  const auto planes = planes_of_symmetry(scene);
  const std::vector<End> ends = ends_of_cracks(scene);
  const auto warning = [&](const End& end, const std::string& other, double clear) {
    return fmt::format(
        "cracks[{}] ends at ({:.6g}, {:.6g}) m, {:.2g} spacings from {}: too near to know when it "
        "goes on there; begin them as one crack, or take a body.spacing of {:.2g} m or less",
        end.crack, end.place[0], end.place[1], clear / spacing, other, 0.5 * clear);
  };
  for (const End& end : ends) {
    const auto is_met = [&](const Vector<2>& off, const Vector<2>& direction) {
      const double away = norm(off);
      return away > 1e-6 * spacing && are_opposed(dot(direction, end.direction)) &&
             meets(away / spacing, dot(off, end.direction) / away);
    };
    for (const End& other : ends) {
      const Vector<2> off = other.place - end.place;
      if (is_met(off, other.direction))
        return warning(end, fmt::format("the end of cracks[{}]", other.crack), norm(off));
    }
    for (int a = 0; a < 2; ++a) {
      Vector<2> image = end.direction;
      image[a] = -image[a];
      for (const double plane : planes[a]) {
        Vector<2> off{};
        off[a] = plane - end.place[a];
        if (is_met(off, image)) return warning(end, "a plane of symmetry", norm(off));
      }
    }
  }
  return {};
}

}  // namespace perifrac
