#pragma once

#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "core/geometry/neighbours.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// What is solid near each point of the body that is in a wall cloud, as it lies at the start.
template <int D>
struct BodyNeighbours {
  /// Of the body's points, then of what else there is, then of the images of all.
  std::array<std::vector<double>, D> position;  ///< [m]
  std::vector<double> volume;
  std::vector<Index> source;  ///< the body's point; -1 of others
  Neighbours near;            ///< of the cloud's points; a point of the body is near itself

  /// `others`: points of the cloud beside those of the body, such as walls at rest.
  BodyNeighbours(const Body<D>& body, const WallCloud<D>& cloud, std::span<const Index> others,
                 const Period<D>& period, double horizon);
};

}  // namespace perifrac
