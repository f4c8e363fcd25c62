#pragma once

#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// Material of the pore space and its fluid.
struct PoreMaterial {
  double biot_coefficient;
  double storage;        ///< at constant strain, phi/K_f + (alpha - phi)/K_s [1/Pa]
  double mobility;       ///< permeability / viscosity [m^2/(Pa s)]
  double fluid_density;  ///< at zero pressure [kg/m^3]
};

/// Its keys in the section of pore flow.
KeyTable pore_material_keys();

/// Reads them; throws InputError.
PoreMaterial read_pore_material(const Section& section);

}  // namespace perifrac
