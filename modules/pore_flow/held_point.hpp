#pragma once

#include "core/geometry/points.hpp"

namespace perifrac {

/// A point whose pressure is prescribed, because it lies in a bonded layer: that of a face value,
/// or none where no fluid is in a sealed layer.
struct HeldPoint {
  Index point;
  int face_value;  ///< -1: dry
};

}  // namespace perifrac
