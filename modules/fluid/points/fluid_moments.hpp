#pragma once

#include <array>
#include <vector>

#include "core/base/ranks.hpp"
#include "core/geometry/neighbour_traversal.hpp"
#include "modules/fluid/points/fluid_points.hpp"

namespace perifrac {

/// What the first of a step's two loops over neighbours finds at every fluid point.
template <int D>
struct FluidMoments {
  /// Inverse of the shape tensor, as the method takes it.
  std::array<std::vector<double>, symmetric_size<D>> inverse_shape;
  std::vector<double> trace;       ///< of the shape tensor, likewise, with images
  std::vector<double> divergence;  ///< of the velocity (paper Eq 20) [1/s]
  std::vector<double> diffusion;   ///< Laplacian of the density, its slope left out [kg/m^5]
  /// Which way neighbours are denser: their mean bond over the shape of a lattice [1/m].
  std::array<std::vector<double>, D> crowding;

  void resize(Index count) {
    for (auto& values : inverse_shape) values.resize(count);
    trace.resize(count);
    divergence.resize(count);
    diffusion.resize(count);
    for (auto& values : crowding) values.resize(count);
  }

  /// Of a loop that was divided among processes.
  void gather() {
    const auto count = static_cast<Index>(divergence.size());
    for (auto& values : inverse_shape) ranks::gather_shares(values, count);
    ranks::gather_shares(trace, count);
    ranks::gather_shares(divergence, count);
    ranks::gather_shares(diffusion, count);
    for (auto& values : crowding) ranks::gather_shares(values, count);
  }

  /// tr M of an endless lattice: what a point inside the fluid has, and every wall point is given.
  double bulk_trace = 0.0;
};

/// tr M of a lattice of `spacing` that fills space [m^(D+2)].
template <int D>
double lattice_trace(double spacing, double horizon, const PairInfluence& influence);

}  // namespace perifrac
