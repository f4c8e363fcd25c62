#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/base/small_vector.hpp"

namespace perifrac {

/// One side of a body: a plane normal to an axis, a sphere (in 2D a circle) or, in 3D, a cylinder
/// along an axis. A face's number is its place in the body's list; those of a box are 2 * axis +
/// (0 low, 1 high), and round holes follow.
struct Face {
  std::string name;
  int axis;                        ///< -1: curved
  int direction;                   ///< outward normal along the axis, or the radius: -1 or +1
  double coordinate;               ///< of the plane along the axis, or the radius [m]
  std::array<double, 3> centre{};  ///< of a curved one [m]
  int along = -1;                  ///< the axis of a cylinder

  bool curved() const { return axis < 0; }
  /// The wall of a hole in the body.
  bool is_hole() const { return curved() && direction < 0; }

  /// From the centre, or the axis, of a curved one to a place [m].
  template <std::size_t D>
  std::array<double, D> ray_to(const std::array<double, D>& x) const {
    std::array<double, D> ray;
    for (int a = 0; a < static_cast<int>(D); ++a) ray[a] = a == along ? 0.0 : x[a] - centre[a];
    return ray;
  }
  template <std::size_t D>
  double place(const std::array<double, D>& x) const {
    return curved() ? norm(ray_to(x)) : x[axis];
  }
  /// How far a place lies behind the face, within the body [m].
  template <std::size_t D>
  double depth(const std::array<double, D>& x) const {
    return direction * (coordinate - place(x));
  }
  /// Outward, at the point of the face that is nearest to a place.
  template <std::size_t D>
  std::array<double, D> normal(const std::array<double, D>& x) const {
    if (curved()) return direction / place(x) * ray_to(x);
    std::array<double, D> n{};
    n[axis] = direction;
    return n;
  }
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
