#include "core/body/cutouts.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_list.hpp"

namespace perifrac {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
// Of a place on the lattice, in spacings; of a bond's length.
constexpr double place_rounding = 1e-9;

/// Images of a ghost overlap where a hole is smaller, and reach beyond a face that is nearer. What
/// walls of two cut-outs bear has to be told apart [horizons].
constexpr double least_radius = 1.0, least_gap = 2.0, least_gap_of_cutouts = 4.0;

/// As many conditions as a ghost's image is looked up by (mirror_condition.hpp).
constexpr std::size_t most_holes = 8;

/// The cut-outs, and their images behind mirrored faces in the order in which ghosts are made.
template <int D>
std::vector<Region<D>> with_images(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                                   FaceSet mirrored) {
  std::vector<Region<D>> all(cutouts.begin(), cutouts.end());
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (!contains(mirrored, f) || faces[f].curved()) continue;
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
      Region<D> image = all[k];
      const int a = faces[f].axis;
      image.from[a] = 2.0 * faces[f].coordinate - all[k].to[a];
      image.to[a] = 2.0 * faces[f].coordinate - all[k].from[a];
      all.push_back(image);
    }
  }
  return all;
}

/// The same of holes.
std::vector<Face> holes_with_images(std::span<const Face> faces, FaceSet mirrored) {
  std::vector<Face> all;
  std::ranges::copy_if(faces, std::back_inserter(all), &Face::is_hole);
  for (int f = 0; f < std::ssize(faces); ++f) {
    if (!contains(mirrored, f) || faces[f].curved()) continue;
    const std::size_t count = all.size();
    for (std::size_t k = 0; k < count; ++k) {
      Face image = all[k];
      double& centre = image.centre[faces[f].axis];
      const double place = 2.0 * faces[f].coordinate - centre;
      if (place == centre || image.along == faces[f].axis) continue;
      centre = place;
      all.push_back(image);
    }
  }
  return all;
}

bool is_round(const Section& body, const std::string& path) {
  return body.has(path + ".radius") || body.has(path + ".centre");
}

template <int D>
Face read_hole(const Section& body, const std::string& name) {
  const std::string path = "cutouts." + name;
  for (const char* key : {".from", ".to"}) {
    if (body.has(path + key)) body.fail(path + key, "of a round cut-out", "centre and radius");
  }
  for (const char* key : {".centre", ".radius"}) {
    if (!body.has(path + key))
      body.fail(path, "a round cut-out needs a centre and a radius", key + 1);
  }
  Face hole{.name = name, .axis = -1, .direction = -1, .coordinate = body.number(path + ".radius")};
  std::ranges::copy(body.numbers(path + ".centre"), hole.centre.begin());
  if (D == 2 && body.has(path + ".axis")) body.fail(path + ".axis", "in 2D", "this left out");
  if (D == 3) {
    if (!body.has(path + ".axis")) body.fail(path, "a hole in 3D has an axis", "axis: x, y or z");
    hole.along = body.word(path + ".axis")[0] - 'x';
    hole.centre[hole.along] = 0.0;
  }
  return hole;
}

/// From the axis of a hole to the nearest place of a box [m].
template <int D>
double distance(const Face& hole, const Region<D>& box) {
  Vector<D> nearest;
  for (int a = 0; a < D; ++a) {
    nearest[a] = a == hole.along ? 0.0 : std::clamp(hole.centre[a], box.from[a], box.to[a]);
  }
  return norm(hole.ray_to(nearest));
}

/// A plane may cut a hole in half, as one of symmetry does.
template <int D>
void check_gaps(const Section& body, const Face& hole, std::span<const Face> planes,
                std::span<const Face> others, std::span<const Region<D>> boxes, double horizon) {
  const std::string path = "cutouts." + hole.name;
  const auto check = [&](double gap, double least, const std::string& what) {
    if (gap >= least * horizon * (1.0 - 1e-9)) return;
    body.fail(path, fmt::format("is {:.6g} m from {}", std::max(gap, 0.0), what),
              fmt::format("at least {:g} horizons, {:g} m", least, least * horizon));
  };
  Vector<D> centre;
  std::copy_n(hole.centre.begin(), D, centre.begin());
  for (const Face& plane : planes) {
    if (plane.axis == hole.along) continue;
    const double depth = plane.depth(centre);
    if (std::abs(depth) <= 1e-6 * horizon) continue;
    check(depth - hole.coordinate, least_gap, fmt::format("face '{}'", plane.name));
  }
  for (const Region<D>& box : boxes) {
    check(distance<D>(hole, box) - hole.coordinate, least_gap_of_cutouts,
          fmt::format("cut-out '{}'", box.name));
  }
  for (const Face& other : others) {
    if (other.along != hole.along) {
      body.fail(path, fmt::format("has another axis than '{}'", other.name), "parallel holes");
    }
    check(norm(other.ray_to(centre)) - other.coordinate - hole.coordinate, least_gap_of_cutouts,
          fmt::format("cut-out '{}'", other.name));
  }
}

}  // namespace

KeyTable cutout_keys() {
  return {
      {.path = "cutouts.*.from",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Low corner of a box that is no part of a body of shape box, such as a notch, "
                  "half-way between points; left out: no end. No bond passes through."},
      {.path = "cutouts.*.to",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "Its high corner; left out: no end."},
      {.path = "cutouts.*.centre",
       .type = KeyType::vector,
       .unit = "m",
       .meaning = "In place of corners, the centre of a round hole, such as a borehole, whose wall "
                  "is a face of the body: `boundary` of a physics may name it. On a face of the "
                  "box: half a hole, as beside a plane of symmetry."},
      {.path = "cutouts.*.radius",
       .unit = "m",
       .range = "(0, inf)",
       .meaning = "Its radius, a horizon at least."},
      {.path = "cutouts.*.axis",
       .type = KeyType::word,
       .words = {"x", "y", "z"},
       .meaning = "In 3D the axis that it runs along, through all of the body."},
  };
}

template <int D>
std::vector<Region<D>> read_cutouts(const Section& body, const Vector<D>& origin, double spacing) {
  std::vector<Region<D>> cutouts;
  if (!body.has("cutouts")) return cutouts;
  for (const std::string& name : body.names("cutouts")) {
    const std::string path = "cutouts." + name;
    if (is_round(body, path)) continue;
    if (body.has(path + ".axis")) body.fail(path + ".axis", "of a box", "centre and radius");
    Region<D> box;
    box.name = name;
    box.from.fill(-infinity);
    box.to.fill(infinity);
    if (body.has(path + ".from")) std::ranges::copy(body.numbers(path + ".from"), box.from.begin());
    if (body.has(path + ".to")) std::ranges::copy(body.numbers(path + ".to"), box.to.begin());
    for (int a = 0; a < D; ++a) {
      for (const auto& [corner, x] : {std::pair{".from", box.from[a]}, {".to", box.to[a]}}) {
        const double cells = (x - origin[a]) / spacing;
        if (!std::isfinite(cells) || std::abs(cells - std::round(cells)) < 1e-6) continue;
        body.fail(path + corner, fmt::format("{:g} m is not a whole number of spacings", x),
                  fmt::format("multiples of body.spacing, {:g} m", spacing));
      }
    }
    cutouts.push_back(box);
  }
  return cutouts;
}

template <int D>
std::vector<Face> read_holes(const Section& body, std::span<const Face> planes,
                             std::span<const Region<D>> boxes, double horizon) {
  std::vector<Face> holes;
  if (!body.has("cutouts")) return holes;
  for (const std::string& name : body.names("cutouts")) {
    const std::string path = "cutouts." + name;
    if (!is_round(body, path)) continue;
    const Face hole = read_hole<D>(body, name);
    if (std::ranges::find(planes, name, &Face::name) != planes.end()) {
      body.fail(path, "a face of the box has this name", "another name");
    }
    if (hole.coordinate < least_radius * horizon * (1.0 - 1e-9)) {
      body.fail(path + ".radius",
                fmt::format("{:g} m is less than the horizon, {:g} m", hole.coordinate, horizon),
                "a wider hole, or points closer together");
    }
    check_gaps<D>(body, hole, planes, holes, boxes, horizon);
    holes.push_back(hole);
    if (holes.size() > most_holes) {
      body.fail(path, fmt::format("more than {} round cut-outs", most_holes), "fewer");
    }
  }
  return holes;
}

template <int D>
void cut_out(const Section& body, std::span<const Region<D>> boxes, std::span<const Face> holes,
             Points<D>& points) {
  std::vector<bool> holds_any(boxes.size(), false);
  Points<D> kept;
  for (Index i = 0; i < points.size(); ++i) {
    const Vector<D> x = points.at(i);
    // One upon the wall would be its own image.
    bool gone = std::ranges::any_of(
        holes, [&](const Face& hole) { return hole.depth(x) <= place_rounding * hole.coordinate; });
    for (std::size_t k = 0; k < boxes.size(); ++k) {
      if (!boxes[k].contains(x)) continue;
      gone = true;
      holds_any[k] = true;
    }
    if (!gone) kept.add(x, points.volume[i]);
  }
  for (std::size_t k = 0; k < boxes.size(); ++k) {
    if (holds_any[k]) continue;
    body.fail("cutouts." + boxes[k].name, "takes no point out of the body",
              "a box of a spacing or more that reaches into the body");
  }
  if (kept.size() == 0) body.fail("cutouts", "nothing is left of the body", "smaller boxes");
  points = std::move(kept);
}

template <int D>
bool passes_through(const Region<D>& box, const Vector<D>& x, const Vector<D>& y) {
  double enters = 0.0, leaves = 1.0;  // along the segment
  for (int a = 0; a < D; ++a) {
    const double along = y[a] - x[a];
    const double low = box.from[a] - x[a], high = box.to[a] - x[a];
    const double margin = place_rounding * (high - low < infinity ? high - low : 0.0);
    if (along == 0.0) {
      if (low >= -margin || high <= margin) return false;
      continue;
    }
    enters = std::max(enters, (along > 0.0 ? low : high) / along);
    leaves = std::min(leaves, (along > 0.0 ? high : low) / along);
  }
  return leaves - enters > place_rounding;
}

template <int D>
bool passes_through(const Face& hole, const Vector<D>& x, const Vector<D>& y) {
  const double inside = hole.coordinate * (1.0 - place_rounding);
  if (hole.place(x) < inside || hole.place(y) < inside) return false;
  const Vector<D> from = hole.ray_to(x);
  const Vector<D> along = hole.ray_to(y) - from;
  const double length = squared_norm(along);
  if (length == 0.0) return false;
  const double nearest = std::clamp(-dot(from, along) / length, 0.0, 1.0);
  return norm(from + nearest * along) < inside;
}

template <int D>
void remove_bonds_through(std::span<const Region<D>> cutouts, std::span<const Face> faces,
                          FaceSet mirrored, Family<D>& family) {
  const std::vector<Region<D>> boxes = with_images<D>(cutouts, faces, mirrored);
  const std::vector<Face> holes = holes_with_images(faces, mirrored);
  if (boxes.empty() && holes.empty()) return;
  BondList<D> list;
  for (Index i = 0; i < family.point_count; ++i) {
    const Vector<D> x = vector_at(family.position, i);
    list.begin_point(i);
    for (const auto& [j, weight] : family.bonds(i)) {
      const Vector<D> y = vector_at(family.position, j);
      const auto is_between = [&](const auto& cutout) { return passes_through<D>(cutout, x, y); };
      if (std::ranges::any_of(boxes, is_between) || std::ranges::any_of(holes, is_between)) {
        continue;
      }
      list.add(j, weight);
    }
    list.end_point();
  }
  list.give_to(family);
}

template std::vector<Face> read_holes<2>(const Section&, std::span<const Face>,
                                         std::span<const Region<2>>, double);
template std::vector<Face> read_holes<3>(const Section&, std::span<const Face>,
                                         std::span<const Region<3>>, double);
template bool passes_through<2>(const Face&, const Vector<2>&, const Vector<2>&);
template bool passes_through<3>(const Face&, const Vector<3>&, const Vector<3>&);
template std::vector<Region<2>> read_cutouts<2>(const Section&, const Vector<2>&, double);
template std::vector<Region<3>> read_cutouts<3>(const Section&, const Vector<3>&, double);
template void cut_out<2>(const Section&, std::span<const Region<2>>, std::span<const Face>,
                         Points<2>&);
template void cut_out<3>(const Section&, std::span<const Region<3>>, std::span<const Face>,
                         Points<3>&);
template bool passes_through<2>(const Region<2>&, const Vector<2>&, const Vector<2>&);
template bool passes_through<3>(const Region<3>&, const Vector<3>&, const Vector<3>&);
template void remove_bonds_through<2>(std::span<const Region<2>>, std::span<const Face>, FaceSet,
                                      Family<2>&);
template void remove_bonds_through<3>(std::span<const Region<3>>, std::span<const Face>, FaceSet,
                                      Family<3>&);

}  // namespace perifrac
