#pragma once

#include <cstdint>
#include <vector>

#include "core/base/points.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"
#include "modules/pore_flow/material/pore_fluid.hpp"

namespace perifrac {

/// What the pores of a rock store.
struct PoreMaterial {
  double biot_coefficient;
  double porosity;
  double grain_storage;  ///< (alpha - phi)/K_s [1/Pa]
  double storage;  ///< at constant strain and zero pressure, phi/K_f + (alpha - phi)/K_s [1/Pa]
};

/// The materials of a body: its own, then those of the regions that the scene names.
struct PoreMaterials {
  std::vector<PoreMaterial> materials;
  std::vector<std::uint8_t> material_of_point;

  const PoreMaterial& at(Index i) const { return materials[material_of_point[i]]; }
  Index points() const { return static_cast<Index>(material_of_point.size()); }
};

/// Its keys in the section of pore flow, those of `regions` included.
KeyTable pore_material_keys();

/// Reads the body's own material and those of the section's regions, in the order that
/// region_of_points() numbers them. Throws InputError.
std::vector<PoreMaterial> read_pore_materials(const Section& section, const PoreFluid& fluid);

}  // namespace perifrac
