#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says which crack in 2D bears more shear at rest than friction between its faces holds, of what
/// presses on them beyond the fluid that is in it at the start: what is too much goes into slip at
/// once, before anything happens.
std::optional<std::string> slip_at_rest_warning(const Section& scene);

}  // namespace perifrac
