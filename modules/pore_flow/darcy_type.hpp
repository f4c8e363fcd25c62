#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `pore_flow: {type: darcy}`.
ModuleType darcy_type();

/// Its keys that no other discretisation has.
KeyTable darcy_operator_keys();

}  // namespace perifrac
