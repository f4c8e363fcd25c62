#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where cracks may begin by themselves, and the rock's own length E' Gc / strength^2 is too short
/// for the points or too long for the body.
std::optional<std::string> nucleus_warning(const Section& scene);

}  // namespace perifrac
