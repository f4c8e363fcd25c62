#include "app/references/comparison.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <unordered_map>

#include <fmt/format.h>

#include "app/simulation/place_reader.hpp"

namespace perifrac {

bool writes(const Section& scene, std::string_view path) {
  const auto last = path.rfind('.');
  const bool top = last == std::string_view::npos;
  const std::string_view parent = top ? "" : path.substr(0, last);
  if (!top && !writes(scene, parent)) return false;
  return std::ranges::count(scene.names(parent), top ? path : path.substr(last + 1)) > 0;
}

void require_word(const Section& scene, const std::string& problem, const std::string& path,
                  std::initializer_list<std::string_view> words) {
  if (scene.has(path) && std::ranges::count(words, scene.word(path)) > 0) return;
  scene.fail("reference.type", "this scene is not " + problem,
             fmt::format("{}: {}", path, fmt::join(words, " or ")));
}

void require_section(const Section& scene, const std::string& problem, const std::string& section) {
  if (writes(scene, section)) return;
  scene.fail("reference.type", "this scene is not " + problem, "a section " + section);
}

void require_absent(const Section& scene, const std::string& problem,
                    std::initializer_list<std::string_view> paths) {
  for (const std::string_view path : paths) {
    if (!writes(scene, path)) continue;
    scene.fail("reference.type", "this scene is not " + problem, fmt::format("no {}", path));
  }
}

bool is_layer(const Section& scene, const std::string& face) {
  const std::string path = "body.boundary." + face;
  return writes(scene, path) && scene.word(path) == "layer";
}

double outside(const Section& scene, const std::string& face) {
  return is_layer(scene, face) ? 0.5 * scene.number("body.spacing") : 0.0;
}

std::vector<Index> points_inside(const Section& scene, const PointSet& points) {
  std::vector<Index> inside;
  if (!writes(scene, "body.size")) {  // a ball has no bonded layers
    inside.resize(points.count);
    std::iota(inside.begin(), inside.end(), 0);
    return inside;
  }
  const std::vector<double> size = scene.numbers("body.size");
  for (std::size_t i = 0; i < points.count; ++i) {
    bool in = true;
    for (int a = 0; a < points.dimension; ++a) {
      in = in && points.position[a][i] > 0.0 && points.position[a][i] < size[a];
    }
    if (in) inside.push_back(static_cast<Index>(i));
  }
  return inside;
}

std::vector<Index> points_along(const Section& scene, const PointSet& points, int axis,
                                const std::vector<double>& origin) {
  const double half_spacing = 0.499 * scene.number("body.spacing");
  const auto off = [&](Index i, int a) { return points.position[a][i] - origin[a]; };
  // A point of a layer may lie as near, but none of the body need lie beside it.
  const std::vector<Index> inside = points_inside(scene, points);
  Index nearest = inside.front();
  double least = INFINITY;
  for (const Index i : inside) {
    double square = 0.0;
    for (int a = 0; a < points.dimension; ++a) square += off(i, a) * off(i, a);
    if (square < least * (1.0 - 1e-9)) {
      least = square;
      nearest = i;
    }
  }
  std::vector<Index> row;
  for (const Index i : inside) {
    bool on_line = true;
    for (int a = 0; a < points.dimension; ++a) {
      on_line = on_line && (a == axis || std::abs(off(i, a) - off(nearest, a)) < half_spacing);
    }
    if (on_line) row.push_back(i);
  }
  std::ranges::sort(row, {}, [&](Index i) { return points.position[axis][i]; });
  return row;
}

std::vector<double> place_on(const std::vector<Index>& row, const PointSet& points, int axis,
                             double x) {
  std::vector<double> place;
  for (int a = 0; a < points.dimension; ++a) place.push_back(points.position[a][row.front()]);
  place[axis] = x;
  return place;
}

Reference::Computed value_at(const Simulation& simulation, const Field& field,
                             const std::vector<double>& place, int component) {
  const auto reader = std::make_shared<PlaceReader>(simulation, field.points(), place, 0.0);
  return [field, reader, component] {
    reader->follow(field.points());
    return reader->value(field, component);
  };
}

std::function<double(double, double)> once_each(std::function<double(double, double)> exact) {
  return [exact = std::move(exact), known = std::unordered_map<double, double>(), of_time = -1.0](
             double place, double t) mutable {
    if (of_time != t) known.clear();
    of_time = t;
    const auto [found, is_new] = known.try_emplace(place);
    if (is_new) found->second = exact(place, t);
    return found->second;
  };
}

Reference::OfTime largest_error(const Field& field, int component, std::vector<Index> points,
                                double scale, ExactField exact) {
  return [=, points = std::move(points), exact = std::move(exact)](double t) {
    const auto values = field.values().subspan(component * field.points().count);
    double largest = 0.0;
    for (const Index i : points) largest = std::max(largest, std::abs(values[i] - exact(i, t)));
    return largest / scale;
  };
}

Reference::Profile profile_along(const std::vector<Index>& row, const PointSet& points, int axis,
                                 const std::string& quantity, const std::string& unit,
                                 const Field& field,
                                 std::function<double(double x, double t)> exact) {
  constexpr std::array names = {"x", "y", "z"};
  std::vector<double> x;
  for (const Index i : row) x.push_back(points.position[axis][i]);
  return {.name = fmt::format("{} along {}", quantity, names[axis]),
          .unit = unit,
          .x_name = names[axis],
          .x = std::move(x),
          .computed = [field, row](std::size_t n) { return field.values()[row[n]]; },
          .exact = std::move(exact)};
}

}  // namespace perifrac
