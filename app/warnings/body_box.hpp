#pragma once

#include <array>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// The lower and the upper corner of a body that is a box [m].
std::array<std::vector<double>, 2> body_box(const Section& scene);

}  // namespace perifrac
