#pragma once

#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// Refuses, at the key `path`, a lattice of more points than any memory holds, before it is made: a
/// slip in a unit shall not end in a wait. Throws InputError.
void refuse_too_many_points(const Section& section, const std::string& path, double points,
                            double spacing);

}  // namespace perifrac
