#include "app/probes.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "core/config/mistakes.hpp"
#include "core/geometry/read_point.hpp"

namespace perifrac {

namespace {

/// `_x` of a vector's components, `_xy` of a tensor's, row by row.
std::string component_suffix(int component, int components) {
  constexpr std::string_view axes = "xyz";
  if (components == 1) return "";
  if (components <= 3) return {'_', axes[component]};
  const int dimension = components == 4 ? 2 : 3;
  return {'_', axes[component / dimension], axes[component % dimension]};
}

bool has_place(const Field& field) { return field.points().dimension > 0; }

/// The body's points never move.
bool is_of_body(const Field& field, const Simulation& simulation) {
  return simulation.has_body() && field.points().name == simulation.points().name;
}

/// Cracks are where there is rock.
bool is_in_rock(const Field& field, const Simulation& simulation) {
  return is_of_body(field, simulation) || (simulation.has_body() && field.points().name == "crack");
}

/// Of points equally near the first; `count` where there are none.
std::size_t nearest_point(const PointSet& points, std::span<const double> place) {
  std::size_t nearest = points.count;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.count; ++i) {
    double square = 0.0;
    for (std::size_t a = 0; a < place.size(); ++a) {
      const double distance = points.position[a][i] - place[a];
      square += distance * distance;
    }
    if (square < least) {
      least = square;
      nearest = i;
    }
  }
  return nearest;
}

}  // namespace

Probes::Probes(const Section& output, const Simulation& simulation) {
  for (const Field& field : fields_of(*simulation.manager)) {
    if (!has_place(field)) add({field, {}}, "");
  }
  Mistakes mistakes;
  for (std::size_t n = 0; n < output.count("probes"); ++n) {
    mistakes.note([&] { read(output, fmt::format("probes[{}]", n), simulation); });
  }
  mistakes.throw_if_any();
}

void Probes::read(const Section& output, const std::string& item, const Simulation& simulation) {
  std::vector<Field> fields = fields_of(*simulation.manager);
  std::erase_if(fields, [](const Field& field) { return !has_place(field); });
  if (output.has(item + ".field")) {
    std::vector<std::string> names;
    for (const Field& field : fields) names.push_back(field.port.name);
    const std::string wanted = output.text(item + ".field");
    std::erase_if(fields, [&](const Field& field) { return field.port.name != wanted; });
    if (fields.empty()) output.fail_unknown(item + ".field", wanted, names);
  }
  const auto of_body = [&](const Field& field) { return is_of_body(field, simulation); };
  const std::string at = item + ".at";
  const auto in_rock = [&](const Field& field) { return is_in_rock(field, simulation); };
  std::size_t point = 0;
  if (std::ranges::any_of(fields, in_rock)) {
    const auto find_point = [&](const auto& body) {
      if (std::ranges::all_of(fields, in_rock) || is_inside(output, at, *body)) {
        point = read_point(output, at, *body);
      } else {
        std::erase_if(fields, of_body);
      }
    };
    std::visit(find_point, simulation.body);
  }
  for (const Field& field : fields) {
    const std::vector<double> place = of_body(field) ? std::vector<double>{} : output.numbers(at);
    add({field, place, point}, " at " + output.text(item + ".name"));
  }
}

void Probes::add(Probe probe, const std::string& suffix) {
  const Port& port = probe.field.port;
  for (int c = 0; c < port.components; ++c) {
    columns_.push_back({port.name + component_suffix(c, port.components) + suffix, port.unit});
  }
  probes_.push_back(std::move(probe));
}

void Probes::append_values(std::vector<double>& row) const {
  for (const Probe& probe : probes_) {
    const PointSet& points = probe.field.points();
    const std::size_t point =
        probe.place.empty() ? probe.point : nearest_point(points, probe.place);
    const std::span<const double> values = probe.field.values();
    for (int c = 0; c < probe.field.port.components; ++c) {
      row.push_back(point < points.count ? values[c * points.count + point]
                                         : std::numeric_limits<double>::quiet_NaN());
    }
  }
}

}  // namespace perifrac
