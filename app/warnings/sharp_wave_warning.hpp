#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// A probe that reads stress in rock with inertia of which a face is struck: fronts are as steep as
/// points allow, and break bonds as they come.
std::optional<std::string> sharp_wave_warning(const Section& scene);

}  // namespace perifrac
