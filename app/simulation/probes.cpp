#include "app/simulation/probes.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "core/body/read_point.hpp"
#include "core/config/mistakes.hpp"

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

}  // namespace

Probes::Probes(const Section& output, const Simulation& simulation, double fluid_spacing) {
  for (const Field& field : fields_of(*simulation.manager)) {
    if (has_place(field)) continue;
    add_columns(field, {}, "");
  }
  Mistakes mistakes;
  for (std::size_t n = 0; n < output.count("probes"); ++n) {
    mistakes.note([&] { read(output, fmt::format("probes[{}]", n), simulation, fluid_spacing); });
  }
  mistakes.throw_if_any();
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
  const auto in_rock = [&](const Field& field) { return is_in_rock(field, simulation); };
  if (std::ranges::any_of(fields, in_rock)) {
    const auto check_place = [&](const auto& body) {
      if (std::ranges::all_of(fields, in_rock)) {
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
    const std::size_t probe = probes_.size();
    probes_.push_back({PlaceReader(simulation, points, output.numbers(at), fluid_spacing), 0});
    for (auto field = fields.begin(); field != others.begin(); ++field) {
      add_columns(*field, probe, suffix);
    }
    probes_.back().column = columns_.size();
    columns_.push_back({fmt::format("{} points read{}", points.name, suffix), ""});
    fields.erase(fields.begin(), others.begin());
  }
}

void Probes::add_columns(const Field& field, std::optional<std::size_t> probe,
                         const std::string& suffix) {
  const auto is_same = [&](const Recorded& other) {
    return other.field.module == field.module && other.field.id == field.id;
  };
  auto recorded = std::ranges::find_if(recorded_, is_same);
  if (recorded == recorded_.end()) recorded = recorded_.insert(recorded, {field, {}});
  for (int c = 0; c < field.port.components; ++c) {
    recorded->columns.push_back({columns_.size(), c, probe});
    columns_.push_back(
        {field.port.name + component_suffix(c, field.port.components) + suffix, field.port.unit});
  }
}

void Probes::append_values(std::vector<double>& row) {
  const std::size_t first = row.size();
  row.resize(first + columns_.size());
  for (Probe& probe : probes_) probe.follows = false;
  for (const auto& [field, columns] : recorded_) {
    const PortView view = field.module->port(field.id);
    for (const Column& one : columns) {
      double& value = row[first + one.column];
      if (!one.probe) {
        value = view.value[one.component];
        continue;
      }
      Probe& probe = probes_[*one.probe];
      if (!probe.follows) probe.reader.follow(*view.points);
      probe.follows = true;
      value = probe.reader.value(view, one.component);
      row[first + probe.column] = static_cast<double>(probe.reader.points_read());
    }
  }
}

}  // namespace perifrac
