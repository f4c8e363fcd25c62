#pragma once

#include "core/body/body.hpp"

namespace perifrac {

/// Where a body reaches farthest against gravity along every axis: at its faces, or where it has
/// none its points [m]. Along an axis without gravity, its high end.
template <int D>
Vector<D> highest_corner(const Body<D>& body, const Vector<D>& gravity);

}  // namespace perifrac
