#pragma once

#include "modules/fluid/points/fluid_forces.hpp"
#include "modules/fluid/points/fluid_moments.hpp"
#include "modules/fluid/points/fluid_neighbours.hpp"
#include "modules/fluid/points/fluid_properties.hpp"

namespace perifrac {

/// All that the forces of one step are found from: positions, velocities, volumes, pressures and
/// moments of points, images and near walls.
template <int D>
struct FluidStep {
  const FluidPoints<D>& points;
  const WallCloud<D>& cloud;
  const FluidNeighbours<D>& neighbours;
  const FluidMoments<D>& moments;
  const FluidProperties& fluid;
  const FluidScheme& scheme;
  const PairInfluence& influence;
  const Vector<D>& gravity;
  /// -p M^-1 at every fluid point, with images.
  const std::array<std::vector<double>, symmetric_size<D>>& stress;
};

/// How fluid and walls press on each other.
template <int D>
class WallForce {
 public:
  virtual ~WallForce() = default;

  /// Adds the walls' force to that on each fluid point, and the heat of friction along them; sets
  /// the opposite force on every near wall point.
  virtual void add(const FluidStep<D>& step, NearWalls<D>& walls, FluidForces<D>& forces) = 0;
};

}  // namespace perifrac
