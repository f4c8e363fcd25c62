#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where a slender body swings so often that its period, which points across it make too long, puts
/// it out of step.
std::optional<std::string> swinging_beam_warning(const Section& scene);

}  // namespace perifrac
