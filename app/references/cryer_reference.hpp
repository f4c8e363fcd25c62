#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A 3D ball, whole or cut by symmetry planes, under a pressure on its drained surface.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_cryer_reference(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
