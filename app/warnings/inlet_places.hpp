#pragma once

#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// Where fluid goes into cracks: at inlets, and at the clusters of wells [m].
std::vector<std::vector<double>> inlet_places(const Section& scene);

}  // namespace perifrac
