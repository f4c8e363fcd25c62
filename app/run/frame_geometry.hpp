#pragma once

#include "app/simulation/simulation.hpp"
#include "core/io/frames.hpp"

namespace perifrac {

/// Of the body its points' volumes and regions, of cracks their facets' corners; nothing of others.
FrameGeometry frame_geometry(const AnyBody& body, const PointSet& points);

}  // namespace perifrac
