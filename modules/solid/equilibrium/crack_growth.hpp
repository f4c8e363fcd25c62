#pragma once

#include <memory>
#include <optional>
#include <type_traits>
#include <vector>

#include "core/module/time_window.hpp"
#include "core/state/state_visitor.hpp"
#include "modules/solid/equilibrium/cracked_work.hpp"
#include "modules/solid/equilibrium/moving_tips.hpp"
#include "modules/solid/fracture/crack_front.hpp"
#include "modules/solid/fracture/crack_nucleation.hpp"
#include "modules/solid/fracture/crack_tips.hpp"

namespace perifrac {

/// When the cracks of a body in equilibrium go on, and when new ones begin: a window ends where the
/// first one does; with fluid in the cracks one does a window, so that the pressure answers before
/// the next, else all that are ready.
template <int D>
class CrackGrowth {
 public:
  /// All must stay. No `tensile_strength`: no crack begins by itself.
  CrackGrowth(const Body<D>& body, CrackedEquilibrium<D>& equilibrium, CrackedWork<D>& work,
              FractureEnergy<D> fracture_energy,
              const std::optional<TensileStrength<D>>& tensile_strength);

  void start(const std::vector<CrackFacet<D>>& seeds, double t);
  /// Where a facet will be due in this window [s], as it came to be last time; the window's end
  /// where none will, or nothing is known.
  double expected_end(const TimeWindow& window) const;
  /// A window is about to be tried.
  void begin(const TimeWindow& window);
  /// Once its equilibrium was solved; false where it has to be passed through once more.
  bool find_tips();
  /// Beside fluid its tips may be within facets.
  bool has_moving_tips() const { return moving_ != nullptr; }
  /// By facet, the part of it that is crack: less than 1 where a tip is within it.
  std::vector<double>& parts();
  /// Where the window is to end [s]: at its end, or at the first event where that is far before.
  double first_event(const TimeWindow& window);
  /// Of a window that stands: cuts what is ready. Throws PieceCutFree, NotPositiveDefinite.
  void grow();

  void visit_state(StateVisitor& visitor);
  void on_restored();

 private:
  double due_share(double length, double most) const;
  bool tips_move() const;
  bool expects_facets() const;
  bool start_moving();
  bool grow_tips(double most, double due);
  double find_nucleus_readiness();
  void begin_cracks(bool has_grown);
  bool begin_crack();

  CrackedEquilibrium<D>& equilibrium_;
  CrackedWork<D>& work_;
  std::conditional_t<D == 2, CrackTips, CrackFront> tips_;
  std::unique_ptr<MovingTips> moving_;           ///< in 2D
  std::vector<double> whole_;                    ///< ones, by facet
  std::unique_ptr<CrackNucleation> nucleation_;  ///< null where no crack begins by itself

  double readiness_ = 0.0;          ///< the largest of the tips, at the end of the window
  double nucleus_readiness_ = 0.0;  ///< that for a new crack likewise
  double readiness_before_ = 0.0;   ///< at the beginning of the window
  double nucleus_before_ = 0.0;     ///< likewise
  double last_growth_ = 0.0;        ///< [s]
  double growth_interval_ = 0.0;    ///< between the last two, 0 before [s]
  double readiness_rate_ = 0.0;     ///< in the last window where it rose, 0 before [1/s]
  double begun_ = 0.0;              ///< the window at hand [s]
  int cuts_ = 0;                    ///< of the window at hand
  struct {
    double length, readiness;
  } tried_{};  ///< the last of them
};

}  // namespace perifrac
