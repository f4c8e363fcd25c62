#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `pore_flow: {type: darcy}`.
ModuleType darcy_type();

}  // namespace perifrac
