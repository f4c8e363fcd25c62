#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// An elastic plate in 2D, clamped at its left and right, that bears its own weight and that of
/// fluid over all of it. Throws InputError for another scene.
std::unique_ptr<Reference> make_water_on_plate_reference(const Section& scene,
                                                         const Simulation& simulation);

}  // namespace perifrac
