#include "app/probes.hpp"

#include <algorithm>

#include <fmt/format.h>

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

}  // namespace

Probes::Probes(const Section& output, const Simulation& simulation, double fluid_spacing) {
  for (const Field& field : fields_of(*simulation.manager)) {
    if (has_place(field)) continue;
    add_columns(field.port, "");
    probes_.push_back({{field}, {}});
  }
  for (std::size_t n = 0; n < output.count("probes"); ++n) {
    read(output, fmt::format("probes[{}]", n), simulation, fluid_spacing);
  }
}

void Probes::read(const Section& output, const std::string& item, const Simulation& simulation,
                  double fluid_spacing) {
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
  if (std::ranges::any_of(fields, of_body)) {
    const auto check_place = [&](const auto& body) {
      if (std::ranges::all_of(fields, of_body)) {
        read_point(output, at, *body);  // refuses a place outside
      } else if (!is_inside(output, at, *body)) {
        std::erase_if(fields, of_body);
      }
    };
    std::visit(check_place, simulation.body);
  }
  const std::string suffix = " at " + output.text(item + ".name");
  while (!fields.empty()) {
    const PointSet& points = fields.front().points();
    const auto others = std::ranges::stable_partition(
        fields, [&](const Field& field) { return field.points().name == points.name; });
    Probe probe{{fields.begin(), others.begin()},
                PlaceReader(simulation, points, output.numbers(at), fluid_spacing)};
    for (const Field& field : probe.fields) add_columns(field.port, suffix);
    columns_.push_back({fmt::format("{} points read{}", points.name, suffix), ""});
    probes_.push_back(std::move(probe));
    fields.erase(fields.begin(), others.begin());
  }
}

void Probes::add_columns(const Port& port, const std::string& suffix) {
  for (int c = 0; c < port.components; ++c) {
    columns_.push_back({port.name + component_suffix(c, port.components) + suffix, port.unit});
  }
}

void Probes::append_values(std::vector<double>& row) {
  for (auto& [fields, reader] : probes_) {
    if (reader) reader->follow(fields.front().points());
    for (const Field& field : fields) {
      for (int c = 0; c < field.port.components; ++c) {
        row.push_back(reader ? reader->value(field, c) : field.values()[c]);
      }
    }
    if (reader) row.push_back(static_cast<double>(reader->points_read()));
  }
}

}  // namespace perifrac
