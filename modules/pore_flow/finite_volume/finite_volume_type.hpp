#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `pore_flow: {type: finite_volume}`.
ModuleType finite_volume_type();

}  // namespace perifrac
