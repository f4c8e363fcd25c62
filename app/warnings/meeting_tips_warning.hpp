#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where two cracks that may grow begin so close to each other's ends, or one to a plane of
/// symmetry, that no J is of one tip alone.
std::optional<std::string> meeting_tips_warning(const Section& scene);

}  // namespace perifrac
