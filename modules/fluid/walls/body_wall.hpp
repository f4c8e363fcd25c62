#pragma once

#include "core/body/body.hpp"
#include "modules/fluid/points/periodic_images.hpp"
#include "modules/fluid/points/wall_cloud.hpp"

namespace perifrac {

/// Takes out the container's points that lie where the body is, for a fluid of this spacing [m].
template <int D>
void leave_room_for_body(const Body<D>& body, double spacing, WallCloud<D>& cloud);

/// Adds the points of the body within `horizon` [m] of its faces to rigid walls; `slips`: without
/// friction. Each gets the depth below the nearest face, and that face's normal: of faces that
/// fluid can be at, if it is near one, else of one that a rigid wall lies at.
template <int D>
void add_body(const Body<D>& body, bool slips, double spacing, double horizon,
              const Period<D>& period, WallCloud<D>& cloud);

}  // namespace perifrac
