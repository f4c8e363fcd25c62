#pragma once

#include <functional>
#include <string>

#include "coupling/manager.hpp"

namespace perifrac {

/// How large the cracks of a solid are by now, as in `crack length 0.113 m`, in 3D their area;
/// empty where there is no such port.
std::string crack_size(const CouplingManager& manager);

/// What the line of progress says besides the time: passes a window so far, and the crack's size.
/// The manager must outlive it.
std::function<std::string()> live_words(const CouplingManager& manager);

}  // namespace perifrac
