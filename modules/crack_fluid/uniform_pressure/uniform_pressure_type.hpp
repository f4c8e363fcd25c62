#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `crack_fluid: {type: uniform_pressure}`.
ModuleType uniform_pressure_type();

}  // namespace perifrac
