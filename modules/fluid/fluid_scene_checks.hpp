#pragma once

#include "core/body/body.hpp"
#include "core/config/section.hpp"
#include "modules/fluid/fluid_dynamics.hpp"

namespace perifrac {

/// Refuses a section `fluid` that has no fluid or too fast a one, or whose parts lie in each other
/// or have one name: blocks, walls, the container, inlets and the body, which may be null. Throws
/// InputError.
template <int D>
void check_fluid_scene(const Section& section, const Body<D>* body, const FluidProperties& fluid,
                       double spacing);

/// Refuses a fluid whose steps are so short that the end of the scene is out of reach. Throws
/// InputError.
template <int D>
void check_fluid_steps(const Section& section, const FluidDynamics<D>& dynamics);

}  // namespace perifrac
