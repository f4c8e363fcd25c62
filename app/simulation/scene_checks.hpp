#pragma once

#include "core/config/section.hpp"

namespace perifrac {

/// What no section can know of itself, because it lies between several. Throws InputError.
void check_sections_together(const Section& scene);

}  // namespace perifrac
