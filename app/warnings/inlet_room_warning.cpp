#include "app/warnings/inlet_room_warning.hpp"

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include <fmt/format.h>

#include "app/simulation/place_reader.hpp"
#include "app/warnings/body_box.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

constexpr double rows = 2.0;  ///< that have to be away from walls [spacings]

/// A box by its lower and its upper corner [m].
using Corners = std::array<std::vector<double>, 2>;

Corners corners_of(const Section& scene, const std::string& path) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Corners box{std::vector<double>(scene.integer("dimension"), -far),
              std::vector<double>(scene.integer("dimension"), far)};
  if (scene.has(path + ".from")) box[0] = scene.numbers(path + ".from");
  if (scene.has(path + ".to")) box[1] = scene.numbers(path + ".to");
  return box;
}

bool holds(const Corners& outer, const Corners& inner) {
  for (std::size_t a = 0; a < inner[0].size(); ++a) {
    if (inner[0][a] < outer[0][a] || inner[1][a] > outer[1][a]) return false;
  }
  return true;
}

/// What of a box is farther from walls than a horizon.
class Room {
 public:
  Room(Corners box, double horizon) : box_(box), room_(std::move(box)), horizon_(horizon) {}

  /// A wall with the fluid inside, open beyond the sides that `is_open(axis, end)`.
  void stay_inside(const Corners& walls, const auto& is_open) {
    for (std::size_t a = 0; a < box_[0].size(); ++a) {
      if (!is_open(a, 0)) room_[0][a] = std::max(room_[0][a], walls[0][a] + horizon_);
      if (!is_open(a, 1)) room_[1][a] = std::min(room_[1][a], walls[1][a] - horizon_);
    }
  }
  /// A wall beside the box.
  void stay_outside(const Corners& wall) {
    for (std::size_t a = 0; a < box_[0].size(); ++a) {
      for (std::size_t b = 0; b < box_[0].size(); ++b) {
        if (b != a && (wall[1][b] <= box_[0][b] || wall[0][b] >= box_[1][b])) return;
      }
      if (wall[1][a] <= box_[0][a]) room_[0][a] = std::max(room_[0][a], wall[1][a] + horizon_);
      if (wall[0][a] >= box_[1][a]) room_[1][a] = std::min(room_[1][a], wall[0][a] - horizon_);
    }
  }

  /// Along some axis walls leave less than that.
  bool is_narrower(double width) const {
    for (std::size_t a = 0; a < box_[0].size(); ++a) {
      const double left = room_[1][a] - room_[0][a];
      if (left < width && left < box_[1][a] - box_[0][a]) return true;
    }
    return false;
  }

 private:
  Corners box_, room_;
  double horizon_;
};

void leave_container(const Section& scene, Room& room) {
  if (!scene.has("fluid.container.from")) return;
  const auto names = scene.integer("dimension") == 2 ? face_names<2>() : face_names<3>();
  room.stay_inside(corners_of(scene, "fluid.container"), [&](std::size_t axis, int end) {
    const std::string face = "fluid.container.faces." + names[2 * axis + end];
    return scene.has(face) && scene.word(face) != "wall";
  });
}

/// The fluid is beside the body, or in one of its cut-outs.
void leave_body(const Section& scene, const Corners& box, Room& room) {
  if (!scene.has("body.size")) return;
  const Corners body = body_box(scene);
  bool is_in_cutout = false;
  for (const std::string& name : scene.names("body.cutouts")) {
    const Corners cutout = corners_of(scene, "body.cutouts." + name);
    if (!holds(cutout, box)) continue;
    is_in_cutout = true;
    room.stay_inside(cutout, [&](std::size_t a, int end) {
      return end == 0 ? cutout[0][a] <= body[0][a] : cutout[1][a] >= body[1][a];
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
    const Corners box = corners_of(scene, inlet);
    Room room(box, horizon);
    leave_container(scene, room);
    for (std::size_t w = 0; w < scene.count("fluid.walls"); ++w)
      room.stay_outside(corners_of(scene, fmt::format("fluid.walls[{}]", w)));
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
