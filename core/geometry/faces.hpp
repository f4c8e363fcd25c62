#pragma once

#include <array>
#include <string>
#include <vector>

namespace perifrac {

/// One plane side of a box, normal to an axis. Faces are numbered 2 * axis + (0 low, 1 high).
struct Face {
  std::string name;
  int axis;
  int direction;      ///< outward normal along the axis: -1 or +1
  double coordinate;  ///< of the plane along the axis [m]
};

/// A set of faces, one bit a face.
using FaceSet = unsigned;

constexpr FaceSet face_bit(int face) { return 1u << face; }
constexpr bool contains(FaceSet set, int face) { return (set & face_bit(face)) != 0; }

/// Names by number: left and right along x; in 3D front and back along y; bottom and top along the
/// last axis, which is the vertical.
template <int D>
std::vector<std::string> face_names() {
  if constexpr (D == 2) {
    return {"left", "right", "bottom", "top"};
  } else {
    return {"left", "right", "front", "back", "bottom", "top"};
  }
}

}  // namespace perifrac
