#pragma once

#include <array>
#include <string>
#include <vector>

namespace perifrac {

/// One side of a body: a plane normal to an axis, or a sphere about the origin (in 2D a circle).
/// A face's number is its place in the body's list; those of a box are 2 * axis + (0 low, 1 high).
struct Face {
  std::string name;
  int axis;           ///< -1: a sphere
  int direction;      ///< outward normal along the axis, or the radius: -1 or +1
  double coordinate;  ///< of the plane along the axis, or the sphere's radius [m]

  bool curved() const { return axis < 0; }
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

/// Faces of a ball about the origin: its surface, after the planes of symmetry of an octant.
template <int D>
std::vector<Face> ball_faces(double radius, bool octant) {
  std::vector<Face> faces;
  for (int a = 0; a < D && octant; ++a) faces.push_back({face_names<D>()[2 * a], a, -1, 0.0});
  faces.push_back({"surface", -1, +1, radius});
  return faces;
}

}  // namespace perifrac
