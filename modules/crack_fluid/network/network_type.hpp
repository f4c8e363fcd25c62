#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `crack_fluid: {type: network}`.
ModuleType crack_network_type();

}  // namespace perifrac
