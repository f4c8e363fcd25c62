#pragma once

#include "core/bonds/family.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac {

/// What the bonds across a plane are of a family, summed over the planes beside its point: where
/// they alone are stretched by s, a body of linear peridynamic points holds
///   G = s^2 [D^2 (k - (D + 2) mu / D) squared + D (D + 2) mu single],  k = lambda + 2 mu / D,
/// per area of the plane (paper Eq 15, where they are chi' and chi).
struct CrossingBonds {
  double single;   ///< integral of A/m over the distance, A = sum of w |xi|^2 across the plane [m]
  double squared;  ///< integral of (A/m)^2 [m]
};

/// Those of the bonds and the lattice in use, planes lying half-way between rows across the x-axis.
template <int D>
CrossingBonds crossing_bonds(const Family<D>& family, double spacing);

/// The stretch limit at which they take the fracture energy [J/m^2].
template <int D>
double consistent_stretch(const IsotropicElasticity<D>& law, double fracture_energy,
                          const CrossingBonds& bonds);

/// Eq 15 as it is printed, for comparison only: chi = 0.239 and chi' = 0.804 horizons,
/// k' = E / [2 (1 - nu)].
double printed_stretch(const IsotropicElasticity<2>& law, double fracture_energy, double horizon);

/// The strain across the line ahead, half a spacing from the tip of a crack that is about to grow:
/// (1 + nu) (1 - 2 nu) K_IC / (E sqrt(pi dx)).
template <int D>
double calibrated_stretch(const IsotropicElasticity<D>& law, double fracture_energy,
                          double spacing);

}  // namespace perifrac
