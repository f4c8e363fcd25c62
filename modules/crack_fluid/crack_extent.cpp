#include "modules/crack_fluid/crack_extent.hpp"

#include <vector>

namespace perifrac {

CrackExtent crack_extent(const CrackGraph& graph, const CrackLiquid& liquid,
                         std::span<const double> unknown, std::span<const double> aperture) {
  std::vector<bool> holds_fluid(graph.facet_count(), false);  // by crack
  for (Index f = 0; f < graph.facet_count(); ++f) {
    if (unknown[f] > liquid.empty()) holds_fluid[graph.crack(f)] = true;
  }
  CrackExtent extent;
  double pressure_sum = 0.0;
  for (Index f = 0; f < graph.facet_count(); ++f) {
    const double wet = graph.length(f) * liquid.fill(unknown[f]);
    extent.volume += graph.length(f) * aperture[f];
    extent.wetted_length += wet;
    pressure_sum += wet * liquid.pressure(unknown[f]);
    if (holds_fluid[graph.crack(f)]) extent.fluid_lag += graph.length(f) - wet;
  }
  if (extent.wetted_length > 0.0) extent.mean_pressure = pressure_sum / extent.wetted_length;
  return extent;
}

}  // namespace perifrac
