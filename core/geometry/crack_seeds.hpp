#pragma once

#include <vector>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "core/geometry/bond_state.hpp"

namespace perifrac {

/// The keys of `cracks`, which a body has from the start.
KeyTable crack_seed_keys();

/// The facets of all cracks that the scene names, in its order: every leg of a path in equal pieces
/// of about a spacing, joined at ends that are equal to the bit. Throws InputError.
std::vector<CrackFacet<2>> read_crack_seeds(const Section& scene, double spacing);

}  // namespace perifrac
