#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Pore flow alone in a box: one face at a pressure, the others sealed.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_diffusion_reference(const Section& scene,
                                                    const Simulation& simulation);

}  // namespace perifrac
