#pragma once

#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// What the scene was understood to say, a line each: its quantities in SI by section, the stress
/// at rest, what closes each crack, toughness.
std::vector<std::string> what_was_read(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
