#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/base/points.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

/// Components of a symmetric tensor: xx, xy, yy; or xx, xy, xz, yy, yz, zz.
template <int D>
inline constexpr int symmetric_size = D*(D + 1) / 2;

/// Place of component (a, b), a <= b, in a symmetric tensor.
template <int D>
constexpr int symmetric_index(int a, int b) {
  return a * D - a * (a - 1) / 2 + (b - a);
}

/// The free fluid's points, structure of arrays. What they carry from step to step; and behind
/// `count` points, in the arrays that neighbours read, their periodic images.
template <int D>
struct FluidPoints {
  Index count = 0;
  std::array<std::vector<double>, D> position;  ///< [m], with images
  std::array<std::vector<double>, D> velocity;  ///< [m/s], with images
  std::vector<double> density;                  ///< [kg/m^3], with images
  std::vector<double> mass;                     ///< [kg; in 2D kg/m]
  std::vector<std::int64_t> id;                 ///< given at birth, never twice
  std::int64_t next_id = 0;

  // Found anew in every step.
  std::vector<double> volume;    ///< mass / density, with images
  std::vector<double> pressure;  ///< [Pa], with images

  void add(const Vector<D>& x, const Vector<D>& v, double rho, double m) {
    trim();
    append(position, x);
    append(velocity, v);
    density.push_back(rho);
    mass.push_back(m);
    id.push_back(next_id++);
    ++count;
  }

  /// Takes out the points for which gone(i) holds, called once each in order; returns how many.
  template <class Gone>
  Index remove_if(Gone&& gone) {
    trim();
    Index kept = 0;
    for (Index i = 0; i < count; ++i) {
      if (gone(i)) continue;
      set_at(position, kept, vector_at(position, i));
      set_at(velocity, kept, vector_at(velocity, i));
      density[kept] = density[i];
      mass[kept] = mass[i];
      id[kept++] = id[i];
    }
    const Index removed = count - kept;
    count = kept;
    mass.resize(kept);
    id.resize(kept);
    trim();
    return removed;
  }

  /// Forgets the images, so that arrays hold the points alone.
  void trim() {
    for (int a = 0; a < D; ++a) {
      position[a].resize(count);
      velocity[a].resize(count);
    }
    density.resize(count);
  }

  Vector<D> at(Index i) const { return vector_at(position, i); }
};

}  // namespace perifrac
