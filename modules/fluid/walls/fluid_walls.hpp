#pragma once

#include "core/body/body.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/points/wall_cloud.hpp"
#include "modules/fluid/walls/rigid_wall.hpp"

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
