#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// The lower and the upper corner of a body that is a box [m].
std::array<std::vector<double>, 2> body_box(const Section& scene);

/// From a place to the nearest face of a body that is a box; infinite for others [m].
double distance_to_faces(const Section& scene, std::span<const double> place);

}  // namespace perifrac
