#pragma once

#include "core/config/mistakes.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// What no section can know of itself, because it lies between several. False where modules cannot
/// be made, which take a section that is missing for granted.
bool check_sections_together(const Section& scene, Mistakes& mistakes);

}  // namespace perifrac
