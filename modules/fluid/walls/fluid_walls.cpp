#include "modules/fluid/walls/fluid_walls.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/geometry/cell_grid.hpp"
#include "core/geometry/lattice.hpp"
#include "modules/fluid/points/fluid_blocks.hpp"
#include "modules/fluid/walls/body_wall.hpp"
#include "modules/fluid/walls/wall_surface.hpp"

namespace perifrac {

namespace {

template <int D>
Vector<D> vector_at(const Section& section, const std::string& path) {
  Vector<D> result{};
  if (section.has(path)) std::ranges::copy(section.numbers(path), result.begin());
  return result;
}

/// What every face of the container is, by a word.
template <int D>
std::vector<std::string> read_container_faces(const Section& section) {
  const auto names = face_names<D>();
  std::vector<std::string> words(2 * D, "wall");
  if (section.has("container.faces")) {
    for (const std::string& name : section.names("container.faces")) {
      const auto face = std::ranges::find(names, name);
      if (face == names.end()) section.fail_unknown("container.faces." + name, name, names);
      words[face - names.begin()] = section.word("container.faces." + name);
    }
  }
  for (int a = 0; a < D; ++a) {
    const bool low = words[2 * a] == "periodic", high = words[2 * a + 1] == "periodic";
    if (low == high) continue;
    section.fail("container.faces." + names[2 * a + (low ? 0 : 1)], "periodic alone",
                 "the face across to be periodic too");
  }
  return words;
}

/// The rigid walls outside the closed faces of a box. Walls go on past open faces and corners.
template <int D>
void read_container(const Section& section, double spacing, double horizon, FluidWalls<D>& walls) {
  for (const char* corner : {"container.from", "container.to"}) {
    if (!section.has(corner)) section.fail(corner, "missing", "a corner of the box");
  }
  const std::array<int, D> cells = cells_of_box<D>(section, "container", spacing);
  const Vector<D> from = vector_at<D>(section, "container.from");
  const Vector<D> to = vector_at<D>(section, "container.to");
  const std::vector<std::string> words = read_container_faces<D>(section);
  const int rows = static_cast<int>(std::ceil(horizon / spacing - 1e-9));
  std::array<int, D> first, counts;
  for (int a = 0; a < D; ++a) {
    if (words[2 * a] == "periodic") walls.period.ends[a] = {from[a], to[a]};
    const int beyond = walls.period.ends[a] ? 0 : rows;
    first[a] = -beyond;
    counts[a] = cells[a] + 2 * beyond;
  }
  const auto find_surface = [&](const Vector<D>& x, DeepestSurface<D>& deepest) {
    for (int a = 0; a < D; ++a) {
      const double below = from[a] - x[a], above = x[a] - to[a];
      if (words[2 * a] == "wall" && below > 0.0) deepest.offer({unit_vector<D>(a, +1), below});
      if (words[2 * a + 1] == "wall" && above > 0.0) deepest.offer({unit_vector<D>(a, -1), above});
    }
  };
  const Points<D> lattice = box_lattice<D>(counts, spacing, first);
  const Index owner = static_cast<Index>(walls.rigid.size());
  const bool slips = section.word("container.slip") == "free";
  for (Index i = 0; i < lattice.size(); ++i) {
    Vector<D> x = lattice.at(i);
    for (int a = 0; a < D; ++a) x[a] += from[a];
    DeepestSurface<D> deepest(depth_rounding * spacing);
    find_surface(x, deepest);
    if (!deepest.found()) continue;
    const auto [normal, depth] = deepest.surface();
    walls.cloud.add(x, normal, depth, lattice.volume[i], slips, owner);
  }
  walls.rigid.push_back({.name = "container"});
}

template <int D>
void read_wall(const Section& section, const std::string& path, double spacing, double horizon,
               FluidWalls<D>& walls) {
  const Vector<D> from = vector_at<D>(section, path + ".from");
  const Vector<D> to = vector_at<D>(section, path + ".to");
  using Motion = typename RigidWall<D>::Motion;
  RigidWall<D> wall{.name = section.text(path + ".name")};
  const std::string motion = section.word(path + ".motion");
  if (motion == "moving") {
    wall.motion = Motion::moving;
    wall.value = vector_at<D>(section, path + ".velocity");
  } else if (motion == "piston") {
    wall.motion = Motion::piston;
    wall.value = vector_at<D>(section, path + ".force");
    wall.mass = section.number(path + ".mass");
    if (wall.value == Vector<D>{}) {
      section.fail(path + ".force", "a piston moves along the force on it, which is 0",
                   "a force along the way that it can move");
    }
  }
  wall.schedule = read_schedule(section, path);
  const bool slips = section.word(path + ".slip") == "free";
  const Points<D> lattice = box_points<D>(section, path, spacing);
  for (Index i = 0; i < lattice.size(); ++i) {
    const Vector<D> x = lattice.at(i);
    NearestSurface<D> nearest(depth_rounding * spacing);
    for (int a = 0; a < D; ++a) {
      nearest.offer({unit_vector<D>(a, -1), x[a] - from[a]});
      nearest.offer({unit_vector<D>(a, +1), to[a] - x[a]});
    }
    const auto [normal, depth] = nearest.surface();
    if (depth > horizon) continue;
    walls.cloud.add(x, normal, depth, lattice.volume[i], slips,
                    static_cast<Index>(walls.rigid.size()));
  }
  walls.rigid.push_back(std::move(wall));
}

/// Where fixed walls lie in each other takes out the later one's points; others may not.
template <int D>
void remove_doubles(const Section& section, double spacing, FluidWalls<D>& walls) {
  WallCloud<D>& cloud = walls.cloud;
  CellGrid<D> grid;
  const double reach = 0.5 * spacing * (1.0 - 1e-6);
  grid.build(positions_of(cloud.position), reach);
  Neighbours near;
  grid.find_others(cloud.size(), reach, near);
  std::vector<bool> doubled(cloud.size(), false);
  for (Index w = 0; w < cloud.size(); ++w) {
    for (Index k = near.offset[w]; k < near.offset[w + 1]; ++k) {
      const Index own = cloud.owner[w], other = cloud.owner[near.other[k]];
      if (own <= other) continue;
      doubled[w] = true;
      using Motion = typename RigidWall<D>::Motion;
      if (walls.rigid[own].motion == Motion::fixed && walls.rigid[other].motion == Motion::fixed) {
        continue;
      }
      const Index first = section.has("container") ? 1 : 0;
      section.fail(fmt::format("walls[{}]", own - first),
                   fmt::format("wall '{}' lies in wall '{}', and one of them moves",
                               walls.rigid[own].name, walls.rigid[other].name),
                   "walls that touch at most");
    }
  }
  cloud.remove_if([&](Index w) { return doubled[w]; });
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table
KeyTable fluid_wall_keys() {
  KeyTable keys = {
      {.path = "container.from",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Low corner of a box that rigid walls hold the fluid in."},
      {.path = "container.to",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Its high corner, whole spacings away."},
      {.path = "container.slip",
       .type = KeyType::word,
       .fallback = "no_slip",
       .words = {"no_slip", "free"},
       .meaning = "no_slip: fluid sticks to the walls. free: they have no friction."},
      {.path = "container.faces.*",
       .type = KeyType::word,
       .words = {"wall", "open", "periodic"},
       .meaning = "open: no wall. periodic: what leaves here comes in at the face across. A face "
                  "that is not named is a wall."},
      {.path = "walls[].name",
       .type = KeyType::text,
       .required = true,
       .meaning = "Name of a rigid box that fluid cannot enter."},
      {.path = "walls[].from",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its low corner."},
      {.path = "walls[].to",
       .type = KeyType::vector,
       .unit = "m",
       .required = true,
       .meaning = "Its high corner, whole spacings away."},
      {.path = "walls[].slip",
       .type = KeyType::word,
       .fallback = "no_slip",
       .words = {"no_slip", "free"},
       .meaning = "As for the container."},
      {.path = "walls[].motion",
       .type = KeyType::word,
       .fallback = "fixed",
       .words = {"fixed", "moving", "piston"},
       .meaning = "moving: with `velocity`. piston: slides along `force`, against the fluid."},
      {.path = "walls[].velocity",
       .type = KeyType::vector,
       .unit = "m/s",
       .required = true,
       .when = "motion=moving",
       .meaning = "Velocity, times the schedule."},
      {.path = "walls[].force",
       .type = KeyType::vector,
       .unit = "N/m|N",
       .required = true,
       .when = "motion=piston",
       .meaning = "Force on the piston, times the schedule."},
      {.path = "walls[].mass",
       .unit = "kg/m|kg",
       .range = "(0, inf)",
       .required = true,
       .when = "motion=piston",
       .meaning = "Mass of the piston."},
  };
  const KeyTable schedule = schedule_keys("walls[].");
  keys.insert(keys.end(), schedule.begin(), schedule.end());
  return keys;
}

template <int D>
FluidWalls<D> read_fluid_walls(const Section& section, const Body<D>* body, bool body_slips,
                               double spacing, double horizon) {
  FluidWalls<D> walls;
  if (section.has("container")) {
    read_container(section, spacing, horizon, walls);
    if (body != nullptr) leave_room_for_body(*body, spacing, walls.cloud);
  }
  for (std::size_t k = 0; k < section.count("walls"); ++k) {
    read_wall(section, fmt::format("walls[{}]", k), spacing, horizon, walls);
  }
  remove_doubles(section, spacing, walls);
  walls.cloud.rigid_count = walls.cloud.size();
  if (body != nullptr) {
    add_body(*body, body_slips, spacing, horizon, walls.period, walls.cloud);
  }
  return walls;
}

template FluidWalls<2> read_fluid_walls<2>(const Section&, const Body<2>*, bool, double, double);
template FluidWalls<3> read_fluid_walls<3>(const Section&, const Body<3>*, bool, double, double);

}  // namespace perifrac
