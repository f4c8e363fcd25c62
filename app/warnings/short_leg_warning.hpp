#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where a crack that may grow turns sharply so near its end that J and the jumps of its tip are
/// partly of another direction.
std::optional<std::string> short_leg_warning(const Section& scene);

}  // namespace perifrac
