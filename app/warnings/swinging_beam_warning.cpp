#include "app/warnings/swinging_beam_warning.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "app/references/comparison.hpp"
#include "app/references/rock.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

namespace {

constexpr double slender = 1.9;  ///< length over thickness

/// How much too long a period is, times the square of the points across: cantilevers 2, 4 and 8
/// times as long as thick are 4.8 % off with 5 points, 1.55 % with 10 and 0.44 % with 20.
constexpr double too_long = 1.6;

/// Of a period, at the end: energies are a fifth of themselves off.
constexpr double out_of_step = 0.06;

/// The square of the first wave number times length of a beam that is fixed at one end, at both.
constexpr double one_end = 3.516, both_ends = 22.37;

bool is_fixed(const Section& scene, const std::string& face) {
  const std::string type = fmt::format("solid.boundary.{}.type", face);
  return scene.has(type) && scene.word(type) == "fixed";
}

bool points_across(const Section& scene, const std::string& vector, std::size_t axis) {
  if (!scene.has(vector)) return false;
  const std::vector<double> values = scene.numbers(vector);
  for (std::size_t a = 0; a < values.size(); ++a) {
    if (a != axis && values[a] != 0.0) return true;
  }
  return false;
}

/// Something acts across the axis.
bool bends(const Section& scene, std::size_t axis) {
  if (writes(scene, "fluid")) return true;
  if (points_across(scene, "gravity", axis) || points_across(scene, "solid.body_force", axis)) {
    return true;
  }
  if (!writes(scene, "solid.boundary")) return false;
  return std::ranges::any_of(scene.names("solid.boundary"), [&](const std::string& face) {
    return points_across(scene, fmt::format("solid.boundary.{}.traction", face), axis);
  });
}

}  // namespace

std::optional<std::string> swinging_beam_warning(const Section& scene) {
  if (!writes(scene, "solid") || scene.text("solid.type") != "dynamic") return {};
  if (!has_elastic_rock(scene) || writes(scene, "solid.damping")) return {};
  if (!scene.has("body.spacing") || scene.text("body.shape") != "box") return {};
  const std::vector<double> size = scene.numbers("body.size");
  const auto longest = std::ranges::max_element(size);
  const auto axis = static_cast<std::size_t>(longest - size.begin());
  const double length = *longest, thickness = std::ranges::min(size);
  const auto faces = scene.integer("dimension") == 2 ? face_names<2>() : face_names<3>();
  const int fixed = is_fixed(scene, faces[2 * axis]) + is_fixed(scene, faces[2 * axis + 1]);
  if (length < slender * thickness || fixed == 0 || !bends(scene, axis)) return {};
  const double stiffness = read_elastic_rock(scene).plane_strain_modulus();
  const double period = 2.0 * M_PI / (fixed == 1 ? one_end : both_ends) * length * length /
                        thickness * std::sqrt(12.0 * scene.number("solid.density") / stiffness);
  const double swings = scene.number("time.end") / period;
  const double points = thickness / scene.number("body.spacing");
  const double late = too_long * swings / (points * points);
  if (!(late > out_of_step)) return {};
  return fmt::format(
      "the body swings some {:.0f} times, by a period that {:.0f} points across it make {:.2g} % "
      "too long: in the end it is {:.0f} % of a swing late; an earlier time.end, or a body.spacing "
      "of {:.2g} m or less",
      swings, points, 100.0 * late / swings, 100.0 * late,
      scene.number("body.spacing") * std::sqrt(out_of_step / late));
}

}  // namespace perifrac
