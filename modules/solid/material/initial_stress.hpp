#pragma once

#include "core/geometry/by_region.hpp"

namespace perifrac {

/// Normal stress of the body at rest along every axis, tension positive [Pa].
template <int D>
using InitialStress = ByRegion<D, Vector<D>>;

}  // namespace perifrac
