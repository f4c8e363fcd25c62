#include "app/filling_warning.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace perifrac {

namespace {

constexpr double least_filled = 2.0;  // spacings

/// Of a field without places; nothing where there is none.
double value_of(const Simulation& simulation, const std::string& name) {
  for (const Field& field : fields_of(*simulation.manager)) {
    if (field.port.name == name) return field.values().front();
  }
  return 0.0;
}

}  // namespace

std::optional<std::string> filling_warning(const Section& scene, const Simulation& simulation) {
  if (!simulation.has_body() || !scene.has("crack_fluid")) return {};
  const double spacing = scene.number("body.spacing");
  const double filled = value_of(simulation, "wetted_length");
  const bool is_on_its_way = value_of(simulation, "fluid_lag") > spacing;
  if (!(filled > 0.0) || filled >= least_filled * spacing || !is_on_its_way) return {};
  return fmt::format(
      "fluid fills {:.2g} m of the cracks in the end, {:.1f} spacings: its pressure and what it "
      "opens are those of facets as long as body.spacing, not of a crack; a later time.end or a "
      "finer body.spacing",
      filled, filled / spacing);
}

}  // namespace perifrac
