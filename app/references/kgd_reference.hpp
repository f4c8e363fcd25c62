#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// `reference.type: kgd`: one wing of a crack that runs from the left face, an axis of symmetry,
/// into a body much larger than itself, against the self-similar solution: length, net pressure and
/// opening at the inlet. Throws InputError.
std::unique_ptr<Reference> make_kgd_reference(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
