#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The keys of the section `damage`.
KeyTable damage_keys();

/// The fracture energy that the scene's cracks grow at [J/m^2]; infinite without a section
/// `damage`.
double read_fracture_energy(const Section& scene);

}  // namespace perifrac
