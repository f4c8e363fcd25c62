#include "app/probes.hpp"

#include <fmt/format.h>

#include "core/geometry/read_point.hpp"

namespace perifrac {

namespace {

constexpr std::array axis_suffix = {"_x", "_y", "_z"};

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
    const char* const axis = field.port.components > 1 ? axis_suffix[c] : "";
    columns_.push_back({field.port.name + axis + suffix, field.port.unit});
  }
}

void Probes::append_values(std::vector<double>& row) const {
  for (const Probe& probe : probes_) row.push_back(probe.field.values()[probe.place]);
}

}  // namespace perifrac
