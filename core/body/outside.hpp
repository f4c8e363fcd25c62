#pragma once

#include "core/body/body.hpp"

namespace perifrac {

/// The face of the body, the layer behind it included, that a place lies beyond by more than
/// rounding; -1 where it lies in the body or on its faces.
template <int D>
int face_before(const Body<D>& body, const Vector<D>& x);

}  // namespace perifrac
