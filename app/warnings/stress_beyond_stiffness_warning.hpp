#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says where the rock at rest bears so much of its stiffness that no small strain goes with it.
std::optional<std::string> stress_beyond_stiffness_warning(const Section& scene);

}  // namespace perifrac
