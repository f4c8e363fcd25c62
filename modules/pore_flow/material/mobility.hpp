#pragma once

#include <vector>

#include "core/base/small_vector.hpp"
#include "core/config/key.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// The keys of permeability in the section of pore flow, those of `regions` included.
KeyTable permeability_keys();

/// Permeability over viscosity [m^2/(Pa s)]: the body's own, then those of the section's regions,
/// in the order that region_of_points() numbers them. Throws InputError.
template <int D>
std::vector<Tensor<D, D>> read_mobilities(const Section& section, double viscosity);

/// The scalar that is the same along every axis and stands on the diagonal alone; -1 if none does.
template <int D>
double isotropic_part(const Tensor<D, D>& mobility);

}  // namespace perifrac
