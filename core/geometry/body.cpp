#include "core/geometry/body.hpp"

#include <cmath>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/geometry/lattice.hpp"

namespace perifrac {

namespace {

std::array<int, 3> cells_along_axes(const Section& section, const std::vector<double>& size,
                                    double spacing) {
  std::array<int, 3> counts{};
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

template <int D>
std::shared_ptr<Body<D>> make_box(const Section& section, double spacing, double horizon,
                                  InfluenceFunction influence) {
  const std::vector<double> size = section.numbers("size");
  const auto cells = cells_along_axes(section, size, spacing);
  std::array<int, D> counts;
  std::vector<Face> faces;
  const auto names = face_names<D>();
  for (int a = 0; a < D; ++a) {
    counts[a] = cells[a];
    faces.push_back({names[2 * a], a, -1, 0.0});
    faces.push_back({names[2 * a + 1], a, +1, cells[a] * spacing});
  }
  return std::make_shared<Body<D>>(box_lattice<D>(counts, spacing), std::move(faces), spacing,
                                   horizon, influence);
}

template <int D>
std::shared_ptr<Body<D>> make_ball(const Section& section, double spacing, double horizon,
                                   InfluenceFunction influence) {
  const double radius = section.number("radius");
  if (radius < horizon) {
    section.fail("radius", fmt::format("{:g} m is less than the horizon, {:g} m", radius, horizon),
                 "a ball that holds a whole family");
  }
  return std::make_shared<Body<D>>(ball_lattice<D>(radius, spacing), std::vector<Face>{}, spacing,
                                   horizon, influence);
}

template <int D>
std::shared_ptr<const Body<D>> make_shape(const Section& section) {
  const double spacing = section.number("spacing");
  const double horizon = section.number("horizon_ratio") * spacing;
  const InfluenceFunction influence = influence_function(section.word("influence_function"));
  const bool box = section.word("shape") == "box";
  const auto body = box ? make_box<D>(section, spacing, horizon, influence)
                        : make_ball<D>(section, spacing, horizon, influence);
  body->set_regions(read_regions<D>(section));
  return body;
}

}  // namespace

template <int D>
Body<D>::Body(Points<D> points, std::vector<Face> faces, double spacing, double horizon,
              InfluenceFunction influence)
    : points_(std::move(points)),
      faces_(std::move(faces)),
      layers_(faces_.size()),
      spacing_(spacing),
      horizon_(horizon),
      influence_(influence) {
  point_set_.name = "body";
  point_set_.dimension = D;
  point_set_.count = points_.volume.size();
  for (int a = 0; a < D; ++a) point_set_.position[a] = points_.position[a];
}

template <int D>
Index Body<D>::nearest_point(const Vector<D>& x) const {
  Index nearest = 0;
  double least = INFINITY;
  for (Index i = 0; i < points_.size(); ++i) {
    double r2 = 0.0;
    for (int a = 0; a < D; ++a) r2 += std::pow(points_.position[a][i] - x[a], 2);
    // A tie between lattice points goes to the first along the curve, whatever the rounding.
    if (r2 < least * (1.0 - 1e-12)) {
      least = r2;
      nearest = i;
    }
  }
  return nearest;
}

template <int D>
std::shared_ptr<const Family<D>> Body<D>::family(FaceSet mirrored, FaceSet) const {
  for (const auto& [faces, shared] : families_) {
    if (auto family = shared.lock(); family && faces == mirrored) return family;
  }
  auto family = std::make_shared<const Family<D>>(
      build_family<D>(points_, faces_, mirrored, horizon_, influence_));
  families_.emplace_back(mirrored, family);
  return family;
}

template <int D>
std::vector<std::shared_ptr<const Family<D>>> Body<D>::families() const {
  std::vector<std::shared_ptr<const Family<D>>> used;
  for (const auto& [faces, shared] : families_) {
    if (auto family = shared.lock()) used.push_back(std::move(family));
  }
  return used;
}

KeyTable body_keys() {
  KeyTable keys = {
      {.path = "shape",
       .type = KeyType::word,
       .required = true,
       .words = {"box", "ball"},
       .meaning = "A box from the origin with edges `size`, or a ball about the origin."},
      {.path = "size",
       .type = KeyType::vector,
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .when = "shape=box",
       .meaning = "Edges of the box, each a whole number of spacings."},
      {.path = "radius",
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .when = "shape=ball",
       .meaning = "Radius of the ball."},
      {.path = "spacing",
       .unit = "m",
       .range = "(0, inf)",
       .required = true,
       .meaning = "Distance between neighbouring points."},
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
  for (const Key& key : region_keys()) keys.push_back(key);
  return keys;
}

AnyBody make_body(const Section& section, int dimension) {
  if (dimension == 2) return make_shape<2>(section);
  return make_shape<3>(section);
}

template class Body<2>;
template class Body<3>;

}  // namespace perifrac
