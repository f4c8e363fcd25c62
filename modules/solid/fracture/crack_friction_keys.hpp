#pragma once

#include <memory>
#include <string>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/fracture/crack_friction.hpp"

namespace perifrac {

/// The key of friction between faces of cracks, in the section of a solid.
Key crack_friction_key();

/// Null where the solid has none. Throws InputError in 3D and beside fluid in cracks.
template <int D>
std::unique_ptr<CrackFriction> read_crack_friction(const Section& section);

/// Throws InputError where the solid has it: `where` is what stands against it, `instead` what
/// goes.
void refuse_crack_friction(const Section& section, const std::string& where,
                           const std::string& instead);

}  // namespace perifrac
