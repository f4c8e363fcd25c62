#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// `reference.type: slit_flow`: steady flow through a straight slit of fixed width between two
/// pressures against the cubic law, w^3 / (12 mu) times the fall of pressure. Throws InputError.
std::unique_ptr<Reference> make_slit_flow_reference(const Section& scene,
                                                    const Simulation& simulation);

}  // namespace perifrac
