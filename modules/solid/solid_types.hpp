#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// What a scene may name under `solid.type`.
ModuleType quasi_static_solid_type();
ModuleType dynamic_solid_type();
ModuleType rigid_solid_type();

}  // namespace perifrac
