#pragma once

#include <memory>

#include "app/references/reference.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// A column, twice as high as wide, that collapses at the left end of a dry tank.
/// Throws InputError for another scene.
std::unique_ptr<Reference> make_dam_break_reference(const Section& scene,
                                                    const Simulation& simulation);

}  // namespace perifrac
