#pragma once

#include "core/geometry/wendland_influence.hpp"
#include "modules/fluid/points/fluid_moments.hpp"
#include "modules/fluid/points/fluid_neighbours.hpp"
#include "modules/fluid/points/fluid_values.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Sums over a smoothing kernel, in place of differential operators: the shape tensor of every
/// point is taken for that of an endless lattice, b I, so that omega / b times the vector to a
/// neighbour is the kernel's gradient.
template <int D>
class SphMoments {
 public:
  /// Sets the moments of all points, with the divergence of the velocity
  ///   div v_i = sum_j V_j (v_j - v_i).grad W_ij
  /// and the diffusion of density of delta-SPH (Antuono, Colagrossi and Marrone 2012),
  ///   2 sum_j V_j omega / b [rho_j - rho_i - (grad rho_i + grad rho_j).y / 2],
  /// its gradients by the inverse of each point's own shape tensor, so that no density that is
  /// linear diffuses, surfaces or not.
  /// `values` are to work with.
  void find(const FluidPoints<D>& points, const NearWalls<D>& walls,
            const FluidNeighbours<D>& neighbours, const WendlandInfluence& influence,
            FluidValues<D>& values, FluidMoments<D>& moments);

 private:
  void find_sums(const FluidPoints<D>& points, const NearWalls<D>& walls,
                 const FluidNeighbours<D>& neighbours, const WendlandInfluence& influence,
                 FluidValues<D>& values, FluidMoments<D>& moments);
  void find_diffusion(const FluidPoints<D>& points, const FluidNeighbours<D>& neighbours,
                      const WendlandInfluence& influence, FluidValues<D>& values,
                      FluidMoments<D>& moments);

  std::array<std::vector<double>, D> slope_;  ///< of the density, with images [kg/m^4]
};

}  // namespace perifrac
