#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"

namespace perifrac {

/// The keys of `boundary`, `body_force` and `density` in the solid's section.
KeyTable solid_boundary_keys();

/// Reads them, and `gravity` of the scene; throws InputError.
template <int D>
SolidBoundary<D> read_solid_boundary(const Section& section, const Body<D>& body);

}  // namespace perifrac
