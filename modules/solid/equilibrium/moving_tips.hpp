#pragma once

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/cracked_equilibrium.hpp"
#include "modules/solid/equilibrium/cracked_work.hpp"
#include "modules/solid/equilibrium/tip_search.hpp"
#include "modules/solid/fracture/crack_tips.hpp"

namespace perifrac {

/// Tips that move within a facet, in a body in equilibrium whose cracks hold fluid, in 2D. The
/// facet is cut when its tip comes to it and opens as the tip crosses it (partial_cuts.hpp), so
/// that the body's answer, the fluid's pressure and the energy are continuous in time.
///
/// Where a tip is at the end of a window is found together with what the window does, from pass to
/// pass: where the openings of the last two facets that are whole are those of the tip's asymptote,
/// at the distance and speed of the tip (implicit level sets: Peirce & Detournay 2008), or where
/// the energy release is Gc, were the fluid of the tip's facet away: fluid cannot pull harder. What
/// the lattice does to openings is asked by even loads on the crack's faces, whose K is that of J
/// at both ends of the facet.
class MovingTips {
 public:
  /// All must stay.
  MovingTips(const Body<2>& body, CrackedEquilibrium<2>& equilibrium, CrackedWork<2>& work,
             CrackTips& tips);

  void start();
  /// These tips go on, turned by these angles; false where nothing lies ahead of any.
  bool add(std::span<const std::pair<CrackTip, double>> tips);

  /// A window is about to be tried: tips are first looked for where they would go at the rate of
  /// before.
  void begin(const TimeWindow& window);
  /// Once the equilibrium was solved: looks for where the tips are at the window's end; false where
  /// the window has to be passed through once more.
  bool find();
  /// The earliest time at which a tip has crossed its facet [s]; the window's end where none has.
  double first_crossed();
  /// The window stands. True where tips have crossed their facets, and began new ones.
  bool conclude();
  /// The body is in equilibrium as the next window begins.
  void note_loads();
  /// By facet, the part of it that its tip has crossed.
  std::vector<double>& parts();

  void visit_state(StateVisitor& visitor);
  void on_restored();

 private:
  struct Tip {
    CrackTip at{};      ///< where its facet begins
    Index facet = -1;   ///< that it is within
    bool ends = false;  ///< with this facet
    Index nearest = -1;
    double part = 0.0;         ///< of its facet that lay behind it as the window began
    double rate = 0.0;         ///< at which that grew last [1/s]
    double per_spacing = 0.0;  ///< spacing over half the crack's length
    // Of even loads of 1 Pa:
    std::array<double, 2> root_of_j{};  ///< as its facet begins and ends; 0: not known
    /// Sliding over opening behind it, by loads of one intensity each, as its facet begins and
    /// ends.
    std::array<double, 2> sliding{};
    double release = 0.0;  ///< of its facet, whole, times 2 [m^2/Pa]
    /// Opening of the last facet and the one before, with its own not cut and cut [m].
    std::array<double, 2> held{}, cut{};
    CutLoad load{};  ///< when last booked

    TipSearch search{};
    double expected_rate = 0.0;  ///< as rate, where the window is tried again [1/s]
  };

  double opened(const Tip& tip, double part) const;
  void hold();
  CrackTip end_of(const Tip& tip) const;
  bool cut_for(const CrackTip& at, double turn);
  double excess(const Tip& tip, std::size_t k, const CutLoad& load,
                std::span<const Vector<2>> jumps) const;
  double root_of_j(const Tip& tip) const;
  double energy_release(const Tip& tip, double released) const;
  double by_law(const Tip& tip, int behind) const;
  TipLaw law(const Tip& tip) const;
  TipFluid fluid(const Tip& tip) const;
  double speed(const Tip& tip, double part) const;
  double within_crack(const Tip& tip, double s) const;
  double foretold(const Tip& tip, double excess) const;
  void ask_loads(std::size_t first);
  void ask_modes(Tip& tip, const CrackTip& at, std::size_t place);
  double mode_ratio(const Tip& tip, std::size_t place, const TipJump& jump) const;
  double turn(const Tip& tip, std::span<const Vector<2>> jumps) const;
  void book();
  void visit_loads(StateVisitor& visitor);

  const Body<2>& body_;
  CrackedEquilibrium<2>& equilibrium_;
  CrackedWork<2>& work_;
  CrackTips& tips_;
  EnergyRelease energy_release_;
  std::vector<Tip> moving_;
  std::vector<double> parts_;
  TimeWindow window_{};
};

}  // namespace perifrac
