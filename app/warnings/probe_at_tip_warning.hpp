#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// A probe beside the end of a crack: what it reads goes with the root of the distance, stresses
/// with its inverse, and the end lies where points say it does.
std::optional<std::string> probe_at_tip_warning(const Section& scene);

}  // namespace perifrac
