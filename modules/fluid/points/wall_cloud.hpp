#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// The normal of a wall across an axis; `direction` is +1 or -1.
template <int D>
Vector<D> unit_vector(int axis, int direction) {
  Vector<D> result{};
  result[axis] = direction;
  return result;
}

/// All points that the fluid cannot enter, as they lie at the start: those of rigid walls, then
/// those of the body within a horizon of its faces.
template <int D>
struct WallCloud {
  std::array<std::vector<double>, D> position;  ///< [m]
  std::array<std::vector<double>, D> normal;    ///< unit, out of the wall into the fluid
  std::vector<double> depth;                    ///< below the wall's surface [m]
  std::vector<double> volume;                   ///< [m^3, m^2 in 2D]
  std::vector<std::uint8_t> slips;              ///< 1: no friction
  /// The rigid wall, by number, that a point is of; or the body's point.
  std::vector<Index> owner;
  Index rigid_count = 0;

  Index size() const { return static_cast<Index>(volume.size()); }

  Vector<D> at(Index w) const { return vector_at(position, w); }
  bool is_rigid(Index w) const { return w < rigid_count; }

  void add(const Vector<D>& x, const Vector<D>& outwards, double below, double v, bool is_slippery,
           Index of) {
    append(position, x);
    append(normal, outwards);
    depth.push_back(below);
    volume.push_back(v);
    slips.push_back(is_slippery);
    owner.push_back(of);
  }

  /// Takes out the points for which gone(w) holds.
  template <class Gone>
  void remove_if(Gone&& gone) {
    Index kept = 0;
    for (Index w = 0; w < size(); ++w) {
      if (gone(w)) continue;
      set_at(position, kept, vector_at(position, w));
      set_at(normal, kept, vector_at(normal, w));
      depth[kept] = depth[w];
      volume[kept] = volume[w];
      slips[kept] = slips[w];
      owner[kept++] = owner[w];
    }
    for (int a = 0; a < D; ++a) {
      position[a].resize(kept);
      normal[a].resize(kept);
    }
    depth.resize(kept);
    volume.resize(kept);
    slips.resize(kept);
    owner.resize(kept);
  }
};

/// The points of a wall cloud that fluid is near, with what fluid points need of them; and behind
/// `count` of them their periodic images. Found anew with the neighbours.
template <int D>
struct NearWalls {
  Index count = 0;
  std::vector<Index> wall;                      ///< which point of the cloud, with images
  std::array<std::vector<double>, D> position;  ///< where it is now [m], with images
  std::array<std::vector<double>, D> velocity;  ///< [m/s], with images
  std::vector<double> volume;                   ///< with images

  // From the fluid around a wall point, in every step.
  std::vector<double> pressure;      ///< extrapolated, not below 0 [Pa], with images
  std::vector<double> fluid_moment;  ///< sum of omega r^2 V over the fluid points, with images
  // On it, by the fluid; images apart.
  std::array<std::vector<double>, D> force;  ///< [N]
  // Into it, by an exchange of mass.
  std::vector<double> mass_rate;                     ///< [kg/s]
  std::array<std::vector<double>, D> momentum_rate;  ///< that goes with it [N]

  Vector<D> at(Index k) const { return vector_at(position, k); }
};

}  // namespace perifrac
