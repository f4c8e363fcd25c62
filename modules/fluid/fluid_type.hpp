#pragma once

#include "core/module/module_type.hpp"

namespace perifrac {

/// `fluid: {type: semi_lagrangian}`.
ModuleType semi_lagrangian_type();

/// The keys of the section `interface`: what free fluid and a body do to each other.
const KeyTable& interface_keys();

}  // namespace perifrac
