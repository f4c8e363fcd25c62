#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A column in 2D or 3D on rollers at its sides, on a roller or fixed at the sealed bottom, under a
/// traction on the drained top. Throws InputError for another scene.
std::unique_ptr<Reference> make_terzaghi_reference(const Section& scene,
                                                   const Simulation& simulation);

/// The same column of two materials: one region of the body, from some height up, differs in
/// permeability or elastic constants. Throws InputError for another scene.
std::unique_ptr<Reference> make_layered_column_reference(const Section& scene,
                                                         const Simulation& simulation);

}  // namespace perifrac
