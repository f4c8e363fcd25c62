#pragma once

#include <optional>
#include <span>

#include "modules/solid/fracture/crack_shape.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"

namespace perifrac {

/// Beyond this a crack has turned so far that even loads say nothing of its tip [rad].
inline constexpr double bent = 0.35;

/// How the faces behind a tip answer to its modes. Those of rows that are oblique to the lattice
/// have teeth: they part where they slide, and slide where they part.
struct ModeAnswer {
  double sliding = 0.0;    ///< by a K_II, over how far they open for a K_I; 0: not known
  double opens = 0.0;      ///< by K_II alone, over how far they slide
  double slides = 0.0;     ///< by K_I alone, over how far they open
  double root_of_j = 0.0;  ///< by a K_I, over how far they open [(J/m^2)^0.5/m]

  /// What K_I opens and K_II slides of a jump.
  TipJump without_teeth(const TipJump& jump) const;
  /// K_II / K_I; 0 of a tip that is closed.
  double ratio(const TipJump& jump) const;
  /// Where the tip has this K_I, K_II: by their ratio, for what viscosity does to one it does to
  /// both, and no more than the sliding says alone, for next to no opening has no ratio. Both over
  /// a toughness, by its root of J [(J/m^2)^0.5].
  double mode_two(const TipJump& jump, double mode_one, double toughness) const;
};

/// What the faces of a tip's crack do under an even pressure of 1 Pa, and under an even shear
/// beside it: how the crack runs across the lattice, which bonds its last facets cut and where its
/// other end is says itself there.
struct EvenLoads {
  double root_of_j;  ///< by the pressure, of K_I: what that is in proportion to
  double volume;     ///< that it opens [m^3], in 2D per metre
  double opening;    ///< that of the facet behind the last, or of the last where there is none [m]
  ModeAnswer modes;
  /// By the shear, of the faces behind the tip and of the facet that `opening` is of [m/Pa]; 0
  /// where the crack bends.
  double slid, opening_by_shear;
};

/// `crack`: the facets that are loaded. Nothing where the crack has just turned, or where no
/// equilibrium says it.
std::optional<EvenLoads> ask_even_loads(CutBody<2>& cracked, const EnergyRelease& energy_release,
                                        const CrackTip& at, std::span<const Index> crack);

}  // namespace perifrac
