#pragma once

#include <span>

#include "modules/solid/equilibrium/cracked_equilibrium.hpp"
#include "modules/solid/equilibrium/moving_tip.hpp"
#include "modules/solid/fracture/crack_tips.hpp"

namespace perifrac {

/// What drives a tip within its facet over what holds it there: K from the openings of the last two
/// facets that are whole over the tip's asymptote at its distance and speed (implicit level sets:
/// Peirce & Detournay 2008), or, where that is more, the root of J over Gc, were the fluid of the
/// tip's facet away: fluid cannot pull harder.
class TipCriterion {
 public:
  /// All must stay. `jumps` of all facets along normal and tangent [m], as a window of this length
  /// [s] ends.
  TipCriterion(const Body<2>& body, CrackedEquilibrium<2>& equilibrium, const CrackTips& tips,
               const EnergyRelease& energy_release, std::span<const Vector<2>> jumps,
               double window_length);

  /// The logarithm of K over what holds the k-th tip.
  double excess(const MovingTip& tip, std::size_t k, const CutLoad& load) const;
  /// Where the tip would be under fluid of fixed volume: intensity falls as the crack grows.
  double foretold(const MovingTip& tip, double excess) const;

 private:
  TipLaw law(const MovingTip& tip) const;
  TipFluid fluid(const MovingTip& tip) const;
  double speed(const MovingTip& tip, double part) const;
  double within_crack(const MovingTip& tip, double s) const;
  double root_of_j(const MovingTip& tip, double part) const;
  double energy_release(const MovingTip& tip, double released) const;
  double by_law(const MovingTip& tip, double part, int behind, double opening) const;
  double over_law(const MovingTip& tip, double part, int behind) const;
  double opens_across(const MovingTip& tip, double part, int behind) const;
  double followed(const MovingTip& tip) const;
  double by_intensity(const MovingTip& tip, double part, int behind, double intensity) const;

  const Body<2>& body_;
  CrackedEquilibrium<2>& equilibrium_;
  const CrackTips& tips_;
  const EnergyRelease& energy_release_;
  std::span<const Vector<2>> jumps_;
  std::span<const double> fluid_weight_;
  double window_length_;
};

}  // namespace perifrac
