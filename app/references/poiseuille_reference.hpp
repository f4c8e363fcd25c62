#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Fluid that fills an endless slit along x and starts to flow under gravity along it.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_poiseuille_reference(const Section& scene,
                                                     const Simulation& simulation);

}  // namespace perifrac
