#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where cracks may begin by themselves, and points are too far apart for the rock's own length
/// E' Gc / strength^2.
std::optional<std::string> nucleus_warning(const Section& scene);

}  // namespace perifrac
