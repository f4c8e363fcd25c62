#pragma once

#include <string>

#include "core/config/section.hpp"

namespace perifrac {

/// What an analytic solution needs to know of the pores and their fluid.
struct PoreRock {
  double biot_coefficient;
  double storage;   ///< at constant strain [1/Pa]
  double mobility;  ///< permeability / viscosity [m^2/(Pa s)]
};

/// Reads it from a scene's pore flow, in one of its regions if it is named there. Throws InputError
/// where the fluid is not linear or the rock not isotropic, so that the scene is not `problem`.
PoreRock read_pore_rock(const Section& scene, const std::string& problem,
                        const std::string& region = "");

}  // namespace perifrac
