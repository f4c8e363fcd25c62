#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/cracked_equilibrium.hpp"
#include "modules/solid/equilibrium/cracked_work.hpp"
#include "modules/solid/equilibrium/moving_tip.hpp"
#include "modules/solid/fracture/crack_tips.hpp"

namespace perifrac {

/// Tips that move within a facet, in a body in equilibrium whose cracks hold fluid, in 2D. The
/// facet is cut when its tip comes to it and opens as the tip crosses it (partial_cuts.hpp), so
/// that the body's answer, the fluid's pressure and the energy are continuous in time.
///
/// Where a tip is at the end of a window is found together with what the window does, from pass to
/// pass (tip_criterion.hpp). What the lattice does to openings is asked by even loads on the
/// crack's faces, whose K is that of J at both ends of the facet.
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
  /// A tip that begins a facet.
  struct GoingOn {
    CrackTip at;
    double turn;                  ///< [rad]
    double scale = 0.0;           ///< as in MovingTip
    std::optional<EvenTip> even;  ///< there, of the body as it is; nothing: to be asked
    double per_spacing = 0.0;
  };

  bool add(std::vector<GoingOn> tips);
  void hold();
  bool cut_for(const CrackTip& at, double turn);
  void ask_loads(std::size_t first);
  void ask_end(MovingTip& tip, std::span<const Index> faces);
  void ask_shapes(MovingTip& tip, std::span<const Index> faces);
  void see_even(const MovingTip& tip, std::span<const Index> faces, std::array<double, 2>& pressed,
                std::array<double, 2>& sheared) const;
  bool turns_sharply(const MovingTip& tip) const;
  CrackShape shape_of(const MovingTip& tip, const CrackTip& at, std::span<const Index> crack) const;
  void scale_shapes(MovingTip& tip) const;
  EvenTip even_at(const CrackTip& at) const;
  double turn(const MovingTip& tip, std::span<const Vector<2>> jumps) const;
  void book();

  const Body<2>& body_;
  CrackedEquilibrium<2>& equilibrium_;
  CrackedWork<2>& work_;
  CrackTips& tips_;
  EnergyRelease energy_release_;
  std::vector<MovingTip> moving_;
  std::vector<double> parts_;
  TimeWindow window_{};
};

}  // namespace perifrac
