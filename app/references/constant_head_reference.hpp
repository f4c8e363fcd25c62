#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Water that a piston presses on a porous box, without pores at first or at the steady state,
/// whose bottom is held at no pressure and whose solid does not deform; no gravity.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_constant_head_reference(const Section& scene,
                                                        const Simulation& simulation);

}  // namespace perifrac
