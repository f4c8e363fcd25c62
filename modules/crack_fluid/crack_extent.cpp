#include "modules/crack_fluid/crack_extent.hpp"

#include <vector>

namespace perifrac {

CrackExtent crack_extent(const CrackGraph& graph, const CrackLiquid& liquid,
                         std::span<const double> unknown, std::span<const double> aperture,
                         std::span<const double> part) {
  std::vector<bool> holds_fluid(graph.facet_count(), false);  // by crack
  for (Index f = 0; f < graph.facet_count(); ++f) {
    if (unknown[f] > liquid.empty()) holds_fluid[graph.crack(f)] = true;
  }
  CrackExtent extent;
  double pressure_sum = 0.0;
  for (Index f = 0; f < graph.facet_count(); ++f) {
    const double area = part[f] * graph.area(f), wet = area * liquid.fill(unknown[f]);
    extent.volume += graph.area(f) * aperture[f];
    extent.wetted_area += wet;
    pressure_sum += wet * liquid.pressure(unknown[f]);
    if (holds_fluid[graph.crack(f)]) extent.dry_area += area - wet;
  }
  if (extent.wetted_area > 0.0) extent.mean_pressure = pressure_sum / extent.wetted_area;
  return extent;
}

}  // namespace perifrac
