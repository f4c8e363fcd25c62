#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/body/body.hpp"
#include "core/body/bonded_layer.hpp"
#include "core/body/cutouts.hpp"
#include "core/body/most_points.hpp"
#include "core/geometry/cloud_points.hpp"
#include "core/geometry/jitter.hpp"
#include "core/geometry/lattice.hpp"
#include "core/geometry/space_filling_curve.hpp"
#include "core/geometry/voronoi.hpp"

namespace perifrac {

namespace {

std::array<int, 3> cells_along_axes(const Section& section, const std::vector<double>& size,
                                    double spacing) {
  std::array<int, 3> counts{};
  double points = 1.0;
  for (const double length : size) points *= std::max(length / spacing, 1.0);
  refuse_too_many_points(section, "spacing", points, spacing);
  for (std::size_t a = 0; a < size.size(); ++a) {
    const double cells = size[a] / spacing;
    counts[a] = static_cast<int>(std::lround(cells));
    if (std::abs(cells - counts[a]) > 1e-6 * cells) {
      section.fail("size", fmt::format("{:g} m is not a whole number of spacings", size[a]),
                   fmt::format("a multiple of body.spacing, {:g} m", spacing));
    }
  }
  return counts;
}

/// The two faces of an axis.
template <int D>
void add_faces(std::vector<Face>& faces, int axis, double low, double high) {
  const auto names = face_names<D>();
  faces.push_back({names[2 * axis], axis, -1, low});
  faces.push_back({names[2 * axis + 1], axis, +1, high});
}

/// Measured: without projection the error of an irregular cloud hardly falls with the spacing.
template <int D>
void set_cloud(const Section& section, Body<D>& body, bool irregular) {
  const bool projected =
      section.has("weights") ? section.word("weights") == "projected" : irregular;
  if (irregular || projected) body.set_irregular(projected);
}

/// What finds volumes or weights for the whole box, or stands for ghosts behind all of a face.
void refuse_beside_cutouts(const Section& section, FaceSet layered) {
  const auto is = [&](const char* key, const char* word) {
    return section.has(key) && section.word(key) == word;
  };
  if (layered == 0 && section.number("jitter") == 0.0 && !is("volumes", "voronoi") &&
      !is("weights", "projected")) {
    return;
  }
  section.fail("cutouts", "beside layers, irregular points or projected weights",
               "a plain lattice without layers");
}

template <int D>
std::shared_ptr<Body<D>> make_box(const Section& section, double spacing, double horizon,
                                  InfluenceFunction influence) {
  const std::vector<double> size = section.numbers("size");
  const auto cells = cells_along_axes(section, size, spacing);
  const auto names = face_names<D>();
  const FaceSet layered = read_layered_faces(section, names);
  const int rows = layer_rows(horizon, spacing);
  std::array<int, D> first, counts;
  std::vector<Face> faces;
  Vector<D> from{}, low, high;
  if (section.has("from")) std::ranges::copy(section.numbers("from"), from.begin());
  for (int a = 0; a < D; ++a) {
    first[a] = contains(layered, 2 * a) ? -rows : 0;
    counts[a] = cells[a] - first[a] + (contains(layered, 2 * a + 1) ? rows : 0);
    low[a] = from[a] + first[a] * spacing;
    high[a] = from[a] + (first[a] + counts[a]) * spacing;
    add_faces<D>(faces, a, from[a], from[a] + cells[a] * spacing);
  }
  Points<D> points = box_lattice<D>(counts, spacing, first);
  for (int a = 0; a < D; ++a) {
    for (double& x : points.position[a]) x += from[a];
  }
  std::vector<Region<D>> cutouts = read_cutouts<D>(section, from, spacing);
  const std::vector<Face> holes = read_holes<D>(section, faces, cutouts, horizon);
  if (!cutouts.empty() || !holes.empty()) refuse_beside_cutouts(section, layered);
  cut_out<D>(section, cutouts, holes, points);
  faces.insert(faces.end(), holes.begin(), holes.end());
  const double jitter = section.number("jitter");
  if (jitter > 0.0) {
    sort_along_curve(points, spacing);  // no packets follow a lattice's rows
    jitter_points(points, jitter * spacing, section.integer("seed"));
  }
  const bool voronoi = section.has("volumes") ? section.word("volumes") == "voronoi" : jitter > 0.0;
  if (voronoi) set_voronoi_volumes<D>(points, low, high, spacing);
  const auto body =
      std::make_shared<Body<D>>(std::move(points), std::move(faces), spacing, horizon, influence);
  body->set_layers(points_behind<D>(body->faces(), layered, body->points()));
  set_cloud(section, *body, jitter > 0.0);
  body->set_cutouts(std::move(cutouts));
  if (layered != 0 && body->irregular()) {
    section.fail("boundary", "a layer behind irregular points or projected weights",
                 "layers on a plain lattice");
  }
  return body;
}

template <int D>
std::shared_ptr<Body<D>> make_cloud(const Section& section, InfluenceFunction influence) {
  CloudPoints<D> cloud = read_cloud_points<D>(section);
  std::vector<Face> faces;
  for (int a = 0; a < D; ++a) add_faces<D>(faces, a, cloud.low[a], cloud.high[a]);
  const auto body =
      std::make_shared<Body<D>>(std::move(cloud.points), std::move(faces), cloud.spacing,
                                section.number("horizon_ratio") * cloud.spacing, influence);
  set_cloud(section, *body, true);
  return body;
}

template <int D>
std::shared_ptr<Body<D>> make_ball(const Section& section, double spacing, double horizon,
                                   InfluenceFunction influence) {
  const double radius = section.number("radius");
  if (radius < horizon) {
    section.fail("radius", fmt::format("{:g} m is less than the horizon, {:g} m", radius, horizon),
                 "a ball that holds a whole family");
  }
  if (section.has("boundary")) {
    section.fail("boundary", "a ball has no layers", "a body of shape box, or this left out");
  }
  refuse_too_many_points(section, "spacing", std::pow(2.0 * radius / spacing, D), spacing);
  const bool octant = section.word("part") == "octant";
  const double jitter = section.number("jitter");
  if (jitter > 0.0 && octant) {
    section.fail("jitter", "an octant's points lie on a lattice", "0, or part: whole");
  }
  Points<D> points = ball_lattice<D>(radius, spacing, octant);
  if (jitter > 0.0) {
    sort_along_curve(points, spacing);
    jitter_points_in_ball(points, jitter * spacing, section.integer("seed"), radius);
  }
  const auto body = std::make_shared<Body<D>>(std::move(points), ball_faces<D>(radius, octant),
                                              spacing, horizon, influence);
  if (jitter > 0.0) body->set_irregular(false);
  return body;
}

template <int D>
std::shared_ptr<const Body<D>> make_shape(const Section& section) {
  const InfluenceFunction influence = influence_function(section.word("influence_function"));
  const std::string shape = section.word("shape");
  if (shape != "box" && section.has("cutouts")) {
    section.fail("cutouts", fmt::format("in a body of shape {}", shape), "a body of shape box");
  }
  std::shared_ptr<Body<D>> body;
  if (shape == "points") {
    body = make_cloud<D>(section, influence);
  } else {
    const double spacing = section.number("spacing");
    const double horizon = section.number("horizon_ratio") * spacing;
    body = shape == "box" ? make_box<D>(section, spacing, horizon, influence)
                          : make_ball<D>(section, spacing, horizon, influence);
  }
  body->set_regions(read_regions<D>(section));
  return body;
}

}  // namespace

// NOLINTNEXTLINE(readability-function-size): a table
KeyTable body_keys() {
  KeyTable keys = {
      {.path = "shape",
       .type = KeyType::word,
       .required = true,
       .words = {"box", "ball", "points"},
       .meaning = "A box with edges `size`, a ball about the origin, or a box "
                  "filled with the points of a `file`."},
      {.path = "size",
       .type = KeyType::vector,
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .when = "shape=box|points",
       .meaning = "Edges of the box; of `shape: box` each a whole number of spacings."},
      {.path = "radius",
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .when = "shape=ball",
       .meaning = "Radius of the ball."},
      {.path = "part",
       .type = KeyType::word,
       .fallback = "whole",
       .words = {"whole", "octant"},
       .when = "shape=ball",
       .meaning = "The whole ball, with the face `surface`; or its octant (in 2D its quadrant) at "
                  "positive coordinates, with faces `left`, `front` (3D) and `bottom` besides."},
      {.path = "spacing",
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .when = "shape=box|ball",
       .meaning = "Distance between neighbouring points."},
      {.path = "jitter",
       .range = "[0, 0.5]",
       .fallback = "0",
       .when = "shape=box|ball",
       .meaning = "How far points are moved off the lattice along each axis, at random, in "
                  "spacings. Points of a ball that would leave it stay."},
      {.path = "seed",
       .type = KeyType::integer,
       .range = "[0, inf)",
       .fallback = "1",
       .when = "shape=box|ball",
       .meaning = "Of the random numbers of `jitter`."},
      {.path = "volumes",
       .type = KeyType::word,
       .words = {"lattice", "voronoi"},
       .when = "shape=box",
       .meaning = "Volumes of the points: all the same, or those of their Voronoi cells within "
                  "the box. Left out: `voronoi` where there is jitter."},
      {.path = "weights",
       .type = KeyType::word,
       .words = {"plain", "projected"},
       .when = "shape=box|points",
       .meaning = "Weights of bonds: the influence function alone, or times factors that give "
                  "irregular points the first two moments of a lattice. Left out: `projected` "
                  "where there is jitter and for `shape: points`. Takes a `horizon_ratio` of 2.5 "
                  "or more."},
      {.path = "horizon_ratio",
       .range = "[1, 10]",
       .fallback = "2.5",
       .meaning = "Horizon over spacing."},
      {.path = "influence_function",
       .type = KeyType::word,
       .fallback = "gaussian",
       .words = {"gaussian", "constant", "inverse"},
       .meaning = "How a bond's weight falls with its length."},
  };
  for (const KeyTable& part : {cloud_keys(), bonded_layer_keys(), region_keys(), cutout_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

AnyBody make_body(const Section& section, int dimension) {
  if (dimension == 2) return make_shape<2>(section);
  return make_shape<3>(section);
}

}  // namespace perifrac
