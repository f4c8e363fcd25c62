#pragma once

#include <memory>

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/solid/fracture/crack_friction.hpp"

namespace perifrac {

/// The key of friction between faces of cracks, in the section of a solid.
Key crack_friction_key();

/// Null where the solid has none.
std::unique_ptr<CrackFriction> read_crack_friction(const Section& section);

}  // namespace perifrac
