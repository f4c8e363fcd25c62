#pragma once

#include <string>

namespace perifrac {

/// Reads a checkpoint; being refused (InputError) is fine, whatever else happens is a fault.
void read_any_checkpoint(const std::string& file);

}  // namespace perifrac
