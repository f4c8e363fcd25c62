#pragma once

#include "core/base/points.hpp"

namespace perifrac {

/// A point whose pressure is prescribed, because it lies in a bonded layer: fluid rests in the
/// layer at its face's pressure, or there is none in a sealed one.
struct HeldPoint {
  Index point;
  int face_value;  ///< -1: dry
};

}  // namespace perifrac
