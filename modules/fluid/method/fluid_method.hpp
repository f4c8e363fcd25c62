#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <tuple>

#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// What sets one method for the free fluid apart from another: how much neighbours count, and what
/// the two loops over them in a step find. All the rest of a step, walls, openings and exchanges
/// take from it what they need of neighbours.
template <int D>
class FluidMethod {
 public:
  virtual ~FluidMethod() = default;

  /// How fluid and wall points count for each other.
  virtual const PairInfluence& influence() const = 0;

  /// Sets the moments of all points from positions, velocities, densities and volumes, those of
  /// images and near walls included; `moments.bulk_trace` is set.
  virtual void find_moments(const FluidPoints<D>& points, const NearWalls<D>& walls,
                            const FluidNeighbours<D>& neighbours, FluidMoments<D>& moments) = 0;

  /// Sets the force on each fluid point by the others, and the heat of their friction.
  virtual void find_forces(const FluidStep<D>& step, FluidForces<D>& forces) = 0;
};

/// A method as scenes name it, `fluid: {type: ...}`.
struct FluidMethodType {
  template <int D>
  using Maker = std::function<std::unique_ptr<FluidMethod<D>>(const FluidScheme&)>;

  std::string name;
  std::string meaning;
  /// By key of the section: what is taken where a scene leaves it out, if not what others take.
  std::map<std::string, std::string> fallbacks;
  std::tuple<Maker<2>, Maker<3>> make;  ///< in 2D and 3D
};

}  // namespace perifrac
