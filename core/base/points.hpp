#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace perifrac {

/// Points are counted in 32 bits: bond lists are what a run's memory goes into.
using Index = std::int32_t;

template <int D>
using Vector = std::array<double, D>;

/// Reference points of a body, structure of arrays.
template <int D>
struct Points {
  std::array<std::vector<double>, D> position;  ///< [m]
  std::vector<double> volume;                   ///< [m^2] per metre in 2D, [m^3] in 3D

  Index size() const { return static_cast<Index>(volume.size()); }

  Vector<D> at(Index i) const {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = position[a][i];
    return x;
  }

  void add(const Vector<D>& x, double v) {
    for (int a = 0; a < D; ++a) position[a].push_back(x[a]);
    volume.push_back(v);
  }
};

}  // namespace perifrac
