#pragma once

#include <span>
#include <vector>

#include "core/config/section.hpp"

namespace perifrac {

/// Which faces of a body that is a box the solid mirrors where this place lies, as numbers of
/// face_names(); none of other bodies.
std::vector<int> mirrors_at(const Section& scene, std::span<const double> place);

}  // namespace perifrac
