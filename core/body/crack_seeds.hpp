#pragma once

#include <vector>

#include "core/bonds/bond_state.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The keys of `cracks`, which a body has from the start.
KeyTable crack_seed_keys();

/// Some bonds are cut from the start, or may break.
bool has_cracks(const Section& scene);

/// The corners of the scene's crack number k, two or more. Throws InputError.
std::vector<Vector<2>> read_crack_corners(const Section& scene, std::size_t k);

/// Its facets: every leg in equal pieces of about a spacing, joined at ends that are equal to the
/// bit. Throws InputError.
std::vector<CrackFacet<2>> read_crack(const Section& scene, std::size_t k, double spacing);

}  // namespace perifrac
