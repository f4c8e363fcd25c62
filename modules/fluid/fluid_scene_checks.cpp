#include "modules/fluid/fluid_scene_checks.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "core/geometry/cell_grid.hpp"
#include "core/geometry/faces.hpp"
#include "modules/fluid/openings/named_box.hpp"
#include "modules/fluid/points/fluid_blocks.hpp"

namespace perifrac {

namespace {

constexpr const char* apart = "boxes that touch at most";

/// More steps than this no run lives to see.
constexpr double most_steps = 2e9;

/// A box in the scene, with what it is called: block 'water'.
template <int D>
struct SceneBox {
  std::string path;
  std::string what;
  Region<D> box;
};

template <int D>
std::vector<SceneBox<D>> boxes_of(const Section& section, const std::string& list,
                                  const std::string& kind) {
  std::vector<SceneBox<D>> boxes;
  for (std::size_t k = 0; k < section.count(list); ++k) {
    const std::string path = fmt::format("{}[{}]", list, k);
    const Region<D> box = read_named_box<D>(section, path);
    boxes.push_back({path, fmt::format("{} '{}'", kind, box.name), box});
  }
  return boxes;
}

void check_names(const Section& section) {
  std::map<std::string, std::string> taken;
  if (section.has("container")) taken["container"] = "the container.";
  for (const char* list : {"blocks", "walls", "inlets", "outlets"}) {
    for (std::size_t k = 0; k < section.count(list); ++k) {
      const std::string path = fmt::format("{}[{}].name", list, k);
      const auto [other, is_new] = taken.emplace(section.text(path), path);
      if (is_new) continue;
      section.fail(path,
                   fmt::format("'{}' is the name of {} too", other->first,
                               other->second.substr(0, other->second.rfind('.'))),
                   "another name");
    }
  }
}

/// Weakly compressible means slow beside sound.
void check_speeds(const Section& section, const FluidProperties& fluid) {
  for (std::size_t k = 0; k < section.count("blocks"); ++k) {
    const std::string path = fmt::format("blocks[{}].velocity", k);
    if (!section.has(path)) continue;
    double square = 0.0;
    for (const double component : section.numbers(path)) square += component * component;
    if (square <= fluid.sound_speed() * fluid.sound_speed()) continue;
    section.fail(path,
                 fmt::format("faster than sound in this fluid, {:.3g} m/s", fluid.sound_speed()),
                 "slower fluid, or a larger bulk_modulus");
  }
}

template <int D>
bool overlap(const Region<D>& one, const Region<D>& other, double tolerance) {
  for (int a = 0; a < D; ++a) {
    if (std::min(one.to[a], other.to[a]) - std::max(one.from[a], other.from[a]) <= tolerance) {
      return false;
    }
  }
  return true;
}

template <int D>
void check_apart(const Section& section, const std::vector<SceneBox<D>>& some,
                 const std::vector<SceneBox<D>>& others, double tolerance) {
  for (const SceneBox<D>& one : some) {
    for (const SceneBox<D>& other : others) {
      if (one.path == other.path || !overlap(one.box, other.box, tolerance)) continue;
      section.fail(one.path, fmt::format("{} overlaps {}", one.what, other.what), apart);
    }
  }
}

/// What lies behind a closed face of the container, or beyond the end of a period.
template <int D>
void check_container(const Section& section, const std::vector<SceneBox<D>>& boxes,
                     double tolerance) {
  if (!section.has("container")) return;
  const std::vector<double> from = section.numbers("container.from");
  const std::vector<double> to = section.numbers("container.to");
  const auto names = face_names<D>();
  for (int face = 0; face < 2 * D; ++face) {
    const std::string path = "container.faces." + names[face];
    if (section.has(path) && section.word(path) == "open") continue;
    const int a = face / 2;
    for (const SceneBox<D>& one : boxes) {
      const double behind = face % 2 == 0 ? from[a] - one.box.from[a] : one.box.to[a] - to[a];
      if (behind <= tolerance) continue;
      section.fail(one.path,
                   fmt::format("{} reaches {:g} m behind the container's face {}", one.what, behind,
                               names[face]),
                   "a box inside the container");
    }
  }
}

/// The first of the points that lies in the cell of a point of the body, or nearer than half a
/// spacing to it.
template <int D>
std::optional<Index> first_in_body(const Body<D>& body, const Positions<D>& points,
                                   double spacing) {
  const double cell = 0.5 * body.spacing() * (1.0 - 1e-6);
  const double near = 0.5 * spacing * (1.0 - 1e-6);
  const double reach = std::max(near, std::sqrt(D) * cell);
  const Positions<D> body_points = positions_of(body.points().position);
  CellGrid<D> grid;
  grid.build(body_points, reach);
  Neighbours found;
  grid.find(points, reach, found);
  for (Index i = 0; i + 1 < static_cast<Index>(found.offset.size()); ++i) {
    for (Index k = found.offset[i]; k < found.offset[i + 1]; ++k) {
      double farthest = 0.0, square = 0.0;
      for (int a = 0; a < D; ++a) {
        const double y = std::abs(points[a][i] - body_points[a][found.other[k]]);
        farthest = std::max(farthest, y);
        square += y * y;
      }
      if (farthest < cell || square < near * near) return i;
    }
  }
  return std::nullopt;
}

template <int D>
void check_points_outside_body(const Section& section, const Body<D>& body,
                               const std::vector<SceneBox<D>>& boxes, double spacing) {
  for (const SceneBox<D>& one : boxes) {
    const Points<D> lattice = box_points<D>(section, one.path, spacing);
    const auto inside = first_in_body<D>(body, positions_of(lattice.position), spacing);
    if (!inside) continue;
    section.fail(one.path,
                 fmt::format("{} reaches into the body, with a point at ({:g}) m", one.what,
                             fmt::join(lattice.at(*inside), ", ")),
                 "a box outside the body");
  }
}

template <int D>
void check_inlets_outside_body(const Section& section, const Body<D>& body,
                               const std::vector<SceneBox<D>>& inlets) {
  for (const SceneBox<D>& inlet : inlets) {
    Region<D> grown = inlet.box;
    for (int a = 0; a < D; ++a) {
      grown.from[a] -= 0.5 * body.spacing() * (1.0 - 1e-6);
      grown.to[a] += 0.5 * body.spacing() * (1.0 - 1e-6);
    }
    for (Index i = 0; i < body.points().size(); ++i) {
      if (!grown.contains(body.points().at(i))) continue;
      section.fail(inlet.path, inlet.what + " reaches into the body", "a box outside the body");
    }
  }
}

}  // namespace

template <int D>
void check_fluid_scene(const Section& section, const Body<D>* body, const FluidProperties& fluid,
                       double spacing) {
  if (section.count("blocks") + section.count("inlets") == 0) {
    section.fail("", "no fluid: neither blocks nor inlets", "some at the start, or a way in");
  }
  check_names(section);
  check_speeds(section, fluid);
  const auto blocks = boxes_of<D>(section, "blocks", "block");
  const auto walls = boxes_of<D>(section, "walls", "wall");
  const auto inlets = boxes_of<D>(section, "inlets", "inlet");
  const double tolerance = 1e-6 * spacing;
  check_apart<D>(section, blocks, blocks, tolerance);
  check_apart<D>(section, blocks, walls, tolerance);
  check_apart<D>(section, inlets, walls, tolerance);
  check_container<D>(section, blocks, tolerance);
  check_container<D>(section, inlets, tolerance);
  if (body == nullptr) return;
  check_points_outside_body<D>(section, *body, blocks, spacing);
  check_points_outside_body<D>(section, *body, walls, spacing);
  check_inlets_outside_body<D>(section, *body, inlets);
}

template <int D>
void check_fluid_steps(const Section& section, const FluidDynamics<D>& dynamics) {
  const double end = section.scene().number("time.end");
  const double step = dynamics.longest_step(0.0);
  if (end / step <= most_steps) return;
  // Steps are as long as the slowness of sound, or the inverse of the viscosity.
  const FluidProperties& fluid = dynamics.fluid();
  const double excess = end / step / most_steps;
  const std::string problem =
      fmt::format("the fluid would take steps of {:.3g} s, {:.2g} of them", step, end / step);
  const double spacing = dynamics.scheme().spacing;
  if (0.25 / D * spacing * spacing * fluid.density / fluid.viscosity <= step * (1.0 + 1e-9)) {
    section.fail("viscosity", problem,
                 fmt::format("at most {:.2g} Pa s, which makes them {:g}, or a shorter time",
                             fluid.viscosity / excess, most_steps));
  }
  section.fail("bulk_modulus", problem,
               fmt::format("at most {:.2g} Pa, which makes them {:g}, or a shorter time",
                           fluid.bulk_modulus / (excess * excess), most_steps));
}

template void check_fluid_scene<2>(const Section&, const Body<2>*, const FluidProperties&, double);
template void check_fluid_scene<3>(const Section&, const Body<3>*, const FluidProperties&, double);
template void check_fluid_steps<2>(const Section&, const FluidDynamics<2>&);
template void check_fluid_steps<3>(const Section&, const FluidDynamics<3>&);

}  // namespace perifrac
