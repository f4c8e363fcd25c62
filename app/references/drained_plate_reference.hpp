#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A solid alone: a box on rollers at its low faces, uniform tractions on its high ones.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_drained_plate_reference(const Section& scene,
                                                        const Simulation& simulation);

}  // namespace perifrac
