#include "core/geometry/body.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "core/errors.hpp"
#include "core/geometry/bonded_layer.hpp"
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
  const auto names = face_names<D>();
  const FaceSet layered = read_layered_faces(section, names);
  const int rows = layer_rows(horizon, spacing);
  std::array<int, D> first, counts;
  std::vector<Face> faces;
  for (int a = 0; a < D; ++a) {
    first[a] = contains(layered, 2 * a) ? -rows : 0;
    counts[a] = cells[a] - first[a] + (contains(layered, 2 * a + 1) ? rows : 0);
    faces.push_back({names[2 * a], a, -1, 0.0});
    faces.push_back({names[2 * a + 1], a, +1, cells[a] * spacing});
  }
  auto body = std::make_shared<Body<D>>(box_lattice<D>(counts, spacing, first), std::move(faces),
                                        spacing, horizon, influence);
  body->set_layers(points_behind<D>(body->faces(), layered, body->points()));
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
double Body<D>::thickness(int axis, FaceSet without_layers) const {
  double sum = 0.0;
  for (int f : {2 * axis, 2 * axis + 1}) {
    const Face& face = faces_[f];
    double reach = face.direction * face.coordinate;
    for (const Index i : contains(without_layers, f) ? std::span<const Index>{} : layer(f)) {
      reach = std::max(reach, face.direction * points_.position[axis][i] + 0.5 * spacing_);
    }
    sum += reach;
  }
  return sum;
}

template <int D>
std::vector<bool> Body<D>::in_layers(FaceSet faces) const {
  std::vector<bool> in(points_.size(), false);
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!contains(faces, f)) continue;
    for (const Index i : layers_[f]) in[i] = true;
  }
  return in;
}

template <int D>
Index Body<D>::nearest_point(const Vector<D>& x) const {
  const std::vector<bool> in_layer = in_layers(~FaceSet{0});
  Index nearest = 0;
  double least = INFINITY;
  for (Index i = 0; i < points_.size(); ++i) {
    if (in_layer[i]) continue;
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
std::shared_ptr<const Family<D>> Body<D>::family(FaceSet mirrored, FaceSet without_layers) const {
  for (const SharedFamily& known : families_) {
    if (known.mirrored != mirrored || known.without_layers != without_layers) continue;
    if (auto family = known.family.lock()) return family;
  }
  check_mirrored_faces(mirrored, without_layers);
  auto family = std::make_shared<const Family<D>>(
      build_family<D>(points_, faces_, mirrored, horizon_, influence_, in_layers(without_layers)));
  families_.push_back({mirrored, without_layers, family});
  return family;
}

template <int D>
void Body<D>::check_mirrored_faces(FaceSet mirrored, FaceSet without_layers) const {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    if (!contains(mirrored, f)) continue;
    if (!layers_[f].empty()) throw std::logic_error("a mirrored face has a layer");
    const double across = thickness(faces_[f].axis, without_layers);
    if (across < horizon_) {
      const auto low = f & ~std::size_t{1};
      throw BodyError(fmt::format("{:g} m between faces '{}' and '{}' is less than the horizon",
                                  across, faces_[low].name, faces_[low + 1].name),
                      fmt::format("at least {:g} m where a face is mirrored", horizon_));
    }
  }
}

template <int D>
std::vector<std::shared_ptr<const Family<D>>> Body<D>::families() const {
  std::vector<std::shared_ptr<const Family<D>>> used;
  for (const SharedFamily& known : families_) {
    if (auto family = known.family.lock()) used.push_back(std::move(family));
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
       .range = "[1.5, 10]",
       .fallback = "2.5",
       .meaning = "Horizon over spacing."},
      {.path = "influence_function",
       .type = KeyType::word,
       .fallback = "gaussian",
       .words = {"gaussian", "constant", "inverse"},
       .meaning = "How a bond's weight falls with its length."},
  };
  for (const KeyTable& part : {bonded_layer_keys(), region_keys()}) {
    keys.insert(keys.end(), part.begin(), part.end());
  }
  return keys;
}

AnyBody make_body(const Section& section, int dimension) {
  if (dimension == 2) return make_shape<2>(section);
  return make_shape<3>(section);
}

template class Body<2>;
template class Body<3>;

}  // namespace perifrac
