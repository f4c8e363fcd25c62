#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "coupling/coupling_options.hpp"

namespace perifrac {

/// The keys of the section `coupling`.
const KeyTable& coupling_keys();

/// Reads them. `duration` is the simulated time [s], from which the windows follow where the scene
/// leaves them out. Throws InputError.
CouplingOptions read_coupling_options(const Section& coupling, double duration);

}  // namespace perifrac
