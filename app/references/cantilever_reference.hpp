#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A dynamic solid alone in 2D: a beam along x, fixed at the left, under a sudden body force.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_cantilever_reference(const Section& scene,
                                                     const Simulation& simulation);

}  // namespace perifrac
