#pragma once

#include <span>

#include "modules/crack_fluid/crack_graph.hpp"
#include "modules/crack_fluid/crack_liquid.hpp"

namespace perifrac {

/// What of a crack its fluid has taken, over all facets; in 2D per metre.
struct CrackExtent {
  double volume = 0.0;         ///< [m^3]
  double wetted_area = 0.0;    ///< [m^2]
  double dry_area = 0.0;       ///< of cracks that hold some fluid, the part without [m^2]
  double mean_pressure = 0.0;  ///< over the wetted area; 0 where there is none [Pa]
};

/// `unknown` is v of crack_liquid.hpp [Pa], `aperture` in [m], `part` how much of a facet is crack.
CrackExtent crack_extent(const CrackGraph& graph, const CrackLiquid& liquid,
                         std::span<const double> unknown, std::span<const double> aperture,
                         std::span<const double> part);

}  // namespace perifrac
