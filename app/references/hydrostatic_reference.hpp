#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Fluid at rest in an open tank: one block that covers the container's floor.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_hydrostatic_reference(const Section& scene,
                                                      const Simulation& simulation);

}  // namespace perifrac
