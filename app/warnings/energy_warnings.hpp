#pragma once

#include <optional>
#include <string>

#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Where what the scene gives at the start is not in balance: the instant answer to it sets free
/// `released` of the energy there is, which nothing holds.
std::optional<std::string> start_warning(const Section& scene, const Simulation& simulation,
                                         double released);

/// Where a run ends with numbers that may mean nothing: its balance of energy is open. Not where
/// there is hardly any energy, as in a body at rest, whose strains are rounding.
std::optional<std::string> balance_warning(const Section& scene, const Simulation& simulation);

}  // namespace perifrac
