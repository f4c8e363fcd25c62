#pragma once

#include <optional>
#include <span>
#include <vector>

#include "core/body/body.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/fracture/crack_state.hpp"
#include "modules/solid/fracture/cut_body.hpp"
#include "modules/solid/fracture/energy_release.hpp"
#include "modules/solid/fracture/even_loads.hpp"
#include "modules/solid/fracture/fracture_energy.hpp"
#include "modules/solid/fracture/tip_law.hpp"

namespace perifrac {

/// The tips of a body's cracks: when they go on, where to, and where they end. A tip goes on by one
/// facet of a spacing where J >= Gc or, where a viscous fluid reaches it, where the opening behind
/// it has grown to the tip's asymptote (tip_law.hpp); straight ahead or turned by the kink angle.
/// Where the facet would come close to the end of another it ends there, and so does the tip.
class CrackTips {
 public:
  CrackTips(const Body<2>& body, CutBody<2>& cracked, FractureEnergy<2> fracture_energy);

  /// Takes the ends of the seeds that no other seed touches and that lie in the rock.
  void start(std::span<const CrackFacet<2>> seeds, double t);
  /// Likewise those of all facets from `first` on.
  void take_ends(std::span<const CrackFacet<2>> facets, std::size_t first, double t);

  /// How close the tips are to growth, the largest: 1 at it.
  double find_readiness(const CrackState<2>& state);
  /// Those that were found ready go on; returns the energy that the new facets take [J/m].
  double grow(const CrackState<2>& state);
  /// What the rock set free in that growth beyond the energy of the new facets, by the mean of J at
  /// their beginning and end; asked once readiness has been found again, in rock without fluid in
  /// its cracks [J/m]. Nothing where a tip ended: of the rock that it parted last J says nothing.
  std::optional<double> excess_release() const;

  /// Those that were found ready are no tips of these any more: they and how they turn [rad].
  std::vector<std::pair<CrackTip, double>> take_ready(const CrackState<2>& state);

  /// Per length of it [J/m^2].
  double energy_to_cut(const CrackFacet<2>& facet) const;
  /// What holds a tip that crosses the facet; `nearest`: point, whose rock it is in.
  TipLaw law(const CrackFacet<2>& facet, Index nearest) const;
  CrackFacet<2> next_facet(const CrackTip& tip, double turn) const;
  /// Cuts a facet ahead of a tip; false, and nothing done, where the tip ends: where the facet
  /// meets no bond, or would cut a chip free, too small for the lattice to tell two cracks apart.
  bool cut_ahead(const CrackFacet<2>& facet);
  /// By which a tip turns that is loaded so, its K being `readiness` times the toughness [rad].
  double turn_of(const CrackTip& tip, const TipModes& modes, double turn_to, const TipLaw& tip_law,
                 double readiness) const;
  /// The facet would come close to an end of another crack's, where it is to end.
  bool joins(const CrackFacet<2>& facet, const CrackTip& tip, Vector<2>& end) const;
  /// Beyond K_I's share, `s` behind a tip that has crossed `part` of its last facet [m]: by stress
  /// at rest that varies, and by the weight of fluid, as in CrackState.
  double opening_by_layers(const CrackTip& at, double s, const TipLaw& tip_law,
                           std::span<const double> fluid_weight, double part = 1.0) const;
  /// The facets that hang together with this one.
  std::vector<Index> crack_of(Index facet) const;

  void visit_state(StateVisitor& visitor);

 private:
  /// Of even loads on the crack's faces: how far they open behind the tip, over the law of the K_I
  /// there is then; and K_I at fixed volume, up to a factor that stays. 0: not known.
  struct EvenLoads {
    double opening = 0.0, intensity = 0.0;
    ModeAnswer modes = {};
    double opens = 0.0;  ///< what `opening` is of, by K_II alone, over how far the faces slide
    bool is_known = false;
  };
  struct Tip {
    CrackTip at{};
    double since = 0.0;  ///< when it came there [s]
    double took = 0.0;   ///< its step before, 0: it had none [s]
    bool moved = false;  ///< it came there by growth
    bool grows = false;  ///< some bond lies ahead
    Index nearest = -1;  ///< point, whose rock it is in
    /// K_I under fluid of fixed volume, over that before the last step: falls as the crack grows.
    double intensity_ratio = 1.0;
    /// What J said last, in the same unit, and the opening of the last facet then [m].
    double asked = 0.0, asked_opening = 0.0;
    double readiness = 0.0;
    std::optional<TipModes> modes = {};  ///< of a tip that fluid follows, over the toughness
    EvenLoads even = {};
    CrackShape shape = {};  ///< empty where it does not turn sharply near it
    double scale = 0.0;     ///< of its crack's shape when that was known last; 0: it never was
    double intensity_before = 0.0;  ///< as even.intensity, before the last step; 0: not known
    /// The last facet's energy, 0 if it is not of the last growth, and what J would have made of it
    /// at its beginning [J/m].
    double spent = 0.0, released = 0.0;
  };

  bool is_followed(const Tip& tip, const CrackState<2>& state) const;
  double readiness(Tip& tip, const CrackState<2>& state, std::span<const Vector<2>> jumps) const;
  double dry_readiness(Tip& tip, const TipLaw& tip_law, const CrackState<2>& state,
                       double lost) const;
  bool is_closed(const CrackTip& at, const CrackState<2>& state) const;
  TipModes followed_modes(Tip& tip, const TipLaw& tip_law, const CrackState<2>& state,
                          std::span<const Vector<2>> jumps) const;
  double beyond_mean(const Tip& tip, const CrackState<2>& state) const;
  double lagging_readiness(Tip& tip, const TipLaw& tip_law, const CrackState<2>& state) const;
  void ask_even_loads(Tip& tip) const;
  double behind(const CrackTip& at) const;
  double within_crack(const Tip& tip, double s) const;
  double turn_of(const Tip& tip, std::span<const Vector<2>> jumps) const;
  double advance(Tip& tip, double turn, double t);

  const Body<2>& body_;
  CutBody<2>& cracked_;
  FractureEnergy<2> fracture_energy_;
  EnergyRelease energy_release_;
  std::vector<Tip> tips_;
};

}  // namespace perifrac
