#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Where a body that is a box is thinner than a horizon (between faces of which one is mirrored it
/// may not be): no point of it has a whole neighbourhood, and it bends too stiffly.
std::optional<std::string> thin_body_warning(const Section& scene);

}  // namespace perifrac
