#pragma once

#include "core/base/point_set.hpp"

namespace perifrac {

/// Where totals of a solid live.
inline const PointSet whole_solid{.name = "solid"};

}  // namespace perifrac
