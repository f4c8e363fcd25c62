#include "app/probes.hpp"

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

}  // namespace

Probes::Probes(const Section& output, const Simulation& simulation) {
  const std::vector<Field> fields = fields_of(*simulation.manager);
  std::vector<std::string> names;
  for (const Field& field : fields) {
    if (has_place(field)) {
      names.push_back(field.port.name);
    } else {
      add(field, 0, 1, "");
    }
  }
  for (std::size_t n = 0; n < output.count("probes"); ++n) {
    const std::string item = fmt::format("probes[{}]", n);
    const Index point = std::visit(
        [&](const auto& body) { return read_point(output, item + ".at", *body); }, simulation.body);
    const std::string suffix = " at " + output.text(item + ".name");
    const bool all = !output.has(item + ".field");
    const std::string wanted = all ? "" : output.text(item + ".field");
    if (!all && std::ranges::count(names, wanted) == 0) {
      output.fail_unknown(item + ".field", wanted, names);
    }
    for (const Field& field : fields) {
      if (has_place(field) && (all || field.port.name == wanted)) {
        add(field, point, simulation.points().count, suffix);
      }
    }
  }
}

void Probes::add(const Field& field, Index point, std::size_t count, const std::string& suffix) {
  for (int c = 0; c < field.port.components; ++c) {
    probes_.push_back({field, c * count + point});
    const std::string name = field.port.name + component_suffix(c, field.port.components);
    columns_.push_back({name + suffix, field.port.unit});
  }
}

void Probes::append_values(std::vector<double>& row) const {
  for (const Probe& probe : probes_) row.push_back(probe.field.values()[probe.place]);
}

}  // namespace perifrac
