#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where the box of an inlet of free fluid is so near walls that all its points, or all but a row,
/// are beside one: more is driven out there than comes in.
std::optional<std::string> inlet_room_warning(const Section& scene);

}  // namespace perifrac
