#pragma once

#include <string>

#include "core/body/body.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The place that a scene gives at `path` [m] lies in the body, or in a cell that sticks out of it.
template <int D>
bool is_inside(const Section& section, const std::string& path, const Body<D>& body);

/// The point of the body nearest to the place that a scene gives at `path` [m]. Throws InputError
/// where that place lies outside the body.
template <int D>
Index read_point(const Section& section, const std::string& path, const Body<D>& body);

}  // namespace perifrac
