#pragma once

#include <array>

namespace perifrac {

/// Strains of an isotropic solid from the stresses along its axes: Hooke's law, plane strain in 2D.
/// `stress` [Pa], tension positive; the third is not read in 2D.
std::array<double, 3> uniform_strain(double youngs_modulus, double poisson_ratio,
                                     std::array<double, 3> stress, int dimension);

}  // namespace perifrac
