#include "app/warnings/inlet_room_warning.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "app/references/free_fluid.hpp"
#include "app/simulation/place_reader.hpp"
#include "app/warnings/body_box.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

constexpr double rows = 2.0;  ///< that have to be away from walls [spacings]

/// Without end where the scene says none.
Box open_box(const Section& scene, const std::string& path) {
  constexpr double far = std::numeric_limits<double>::infinity();
  const std::vector<double> all(scene.integer("dimension"), far), none(all.size(), -far);
  return {scene.has(path + ".from") ? scene.numbers(path + ".from") : none,
          scene.has(path + ".to") ? scene.numbers(path + ".to") : all};
}

bool holds(const Box& outer, const Box& inner) {
  for (std::size_t a = 0; a < inner.from.size(); ++a) {
    if (inner.from[a] < outer.from[a] || inner.to[a] > outer.to[a]) return false;
  }
  return true;
}

/// What of a box is farther from walls than a horizon.
class Room {
 public:
  Room(Box box, double horizon) : box_(box), room_(std::move(box)), horizon_(horizon) {}

  /// A wall with the fluid inside, open beyond the sides that `is_open(axis, end)`.
  void stay_inside(const Box& walls, const auto& is_open) {
    for (std::size_t a = 0; a < box_.from.size(); ++a) {
      if (!is_open(a, 0)) room_.from[a] = std::max(room_.from[a], walls.from[a] + horizon_);
      if (!is_open(a, 1)) room_.to[a] = std::min(room_.to[a], walls.to[a] - horizon_);
    }
  }
  /// A wall beside the box.
  void stay_outside(const Box& wall) {
    for (std::size_t a = 0; a < box_.from.size(); ++a) {
      for (std::size_t b = 0; b < box_.from.size(); ++b) {
        if (b != a && (wall.to[b] <= box_.from[b] || wall.from[b] >= box_.to[b])) return;
      }
      if (wall.to[a] <= box_.from[a])
        room_.from[a] = std::max(room_.from[a], wall.to[a] + horizon_);
      if (wall.from[a] >= box_.to[a]) room_.to[a] = std::min(room_.to[a], wall.from[a] - horizon_);
    }
  }

  /// Along some axis walls leave less than that.
  bool is_narrower(double width) const {
    for (std::size_t a = 0; a < box_.from.size(); ++a) {
      const double left = room_.to[a] - room_.from[a];
      if (left < width && left < box_.to[a] - box_.from[a]) return true;
    }
    return false;
  }

 private:
  Box box_, room_;
  double horizon_;
};

void leave_container(const Section& scene, Room& room) {
  if (!scene.has("fluid.container.from")) return;
  const auto names = scene.integer("dimension") == 2 ? face_names<2>() : face_names<3>();
  room.stay_inside(open_box(scene, "fluid.container"), [&](std::size_t axis, int end) {
    const std::string face = "fluid.container.faces." + names[2 * axis + end];
    return scene.has(face) && scene.word(face) != "wall";
  });
}

/// The fluid is beside the body, or in one of its cut-outs.
void leave_body(const Section& scene, const Box& box, Room& room) {
  if (!scene.has("body.size")) return;
  const auto corners = body_box(scene);
  const Box body{corners[0], corners[1]};
  bool is_in_cutout = false;
  for (const std::string& name : scene.names("body.cutouts")) {
    const Box cutout = open_box(scene, "body.cutouts." + name);
    if (!holds(cutout, box)) continue;
    is_in_cutout = true;
    room.stay_inside(cutout, [&](std::size_t a, int end) {
      return end == 0 ? cutout.from[a] <= body.from[a] : cutout.to[a] >= body.to[a];
    });
  }
  if (!is_in_cutout) room.stay_outside(body);
}

}  // namespace

std::optional<std::string> inlet_room_warning(const Section& scene) {
  if (!scene.has("fluid.inlets")) return {};
  const double spacing = fluid_spacing(scene);
  const double horizon = scene.number("fluid.horizon_ratio") * spacing;
  for (std::size_t k = 0; k < scene.count("fluid.inlets"); ++k) {
    const std::string inlet = fmt::format("fluid.inlets[{}]", k);
    const Box box = open_box(scene, inlet);
    Room room(box, horizon);
    leave_container(scene, room);
    for (std::size_t w = 0; w < scene.count("fluid.walls"); ++w)
      room.stay_outside(open_box(scene, fmt::format("fluid.walls[{}]", w)));
    leave_body(scene, box, room);
    if (!room.is_narrower(rows * spacing * (1.0 - 1e-9))) continue;
    return fmt::format(
        "{} '{}' lies so near walls that hardly a point of it is farther from one than the fluid's "
        "horizon, {:g} m: more is driven out there than comes in, by up to a half, and where that "
        "is fast density and pressure run away; leave a horizon and {:g} m of box, bring points "
        "closer together, or let a piston drive the fluid",
        inlet, scene.text(inlet + ".name"), horizon, rows * spacing);
  }
  return {};
}

}  // namespace perifrac
