#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/body.hpp"
#include "modules/fluid/periodic_images.hpp"
#include "modules/fluid/rigid_wall.hpp"
#include "modules/fluid/wall_cloud.hpp"

namespace perifrac {

/// The keys of `container` and `walls` in the section of the fluid.
KeyTable fluid_wall_keys();

/// Everything that holds the fluid.
template <int D>
struct FluidWalls {
  WallCloud<D> cloud;
  std::vector<RigidWall<D>> rigid;  ///< the container first, if there is one
  Period<D> period;
};

/// Reads them and adds the points of the body, if there is one, within `horizon` [m] of its faces;
/// `body_slips`: without friction. Throws InputError.
template <int D>
FluidWalls<D> read_fluid_walls(const Section& section, const Body<D>* body, bool body_slips,
                               double spacing, double horizon);

}  // namespace perifrac
