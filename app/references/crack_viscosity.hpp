#pragma once

#include "core/config/section.hpp"

namespace perifrac {

/// Of the fluid in cracks; 0 of a kind that does not ask for one [Pa s].
double crack_viscosity(const Section& scene);

}  // namespace perifrac
