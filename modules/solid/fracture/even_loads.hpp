#pragma once

#include <optional>
#include <span>

#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {

/// Beyond this a crack has turned so far that even loads say nothing of its tip [rad].
inline constexpr double bent = 0.35;

/// What the faces of a tip's crack do under an even pressure of 1 Pa, and under an even shear
/// beside it: how the crack runs across the lattice, which bonds its last facets cut and where its
/// other end is says itself there.
struct EvenLoads {
  double root_of_j;  ///< by the pressure, what K_I is in proportion to
  double volume;     ///< that it opens [m^3], in 2D per metre
  double opening;    ///< that of the facet behind the last, or of the last where there is none [m]
  double sliding;    ///< by a K_II, over how far they open for a K_I; 0: not known
};

/// `crack`: the facets that are loaded. Nothing where the crack has just turned, or where no
/// equilibrium says it.
std::optional<EvenLoads> ask_even_loads(CutBody<2>& cracked, const EnergyRelease& energy_release,
                                        const CrackTip& at, std::span<const Index> crack);

}  // namespace perifrac
