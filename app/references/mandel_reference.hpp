#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A quarter of Mandel's slab: a 2D box on rollers at left and bottom, a rigid plate at the top,
/// drained at the right.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_mandel_reference(const Section& scene,
                                                 const Simulation& simulation);

}  // namespace perifrac
