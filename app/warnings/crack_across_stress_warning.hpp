#pragma once

#include <optional>
#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Says which crack that fluid is pumped into lies across the larger stress by so much that rock
/// would turn it: its straight path is unstable (Cotterell and Rice 1980); or so aslant to it that
/// shear makes it jump; or which crack slides, without friction, before fluid is there.
std::optional<std::string> crack_across_stress_warning(const Section& scene);

}  // namespace perifrac
