#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/module/time_window.hpp"
#include "core/state/snapshot.hpp"
#include "coupling/acceleration.hpp"
#include "coupling/connect.hpp"
#include "coupling/link.hpp"
#include "coupling/module_slot.hpp"
#include "coupling/stability_watch.hpp"

namespace perifrac {

/// How often a window may be tried, and when it is done.
struct Iterations {
  int max;           ///< 1: one pass, whatever the mismatch
  double tolerance;  ///< largest relative mismatch of any lagged link
  /// The same after the first pass, of those links that send a slope; 0: no exception is made.
  double at_once = 0.0;
};

/// What the exchange cost in this process.
struct CouplingWork {
  std::int64_t windows = 0;
  std::int64_t passes = 0;       ///< over all modules; more than windows by iterating and by events
  std::int64_t most_passes = 0;  ///< in any one window
  std::int64_t events = 0;       ///< windows that a module ended early
  std::int64_t cuts = 0;         ///< windows taken back and tried again half as long
};

/// Takes all modules through one window: predict, advance in order and exchange, compare, go back
/// and repeat; after an event, go back and redo the window to the event.
///
/// The modules' state is saved at every window's beginning if it may be repeated: by iterations,
/// because some module may end it at an event, which is known only once the state is gone, or
/// because it may be cut, unless nothing but the modules' own steps is in it.
class WindowSolver {
 public:
  WindowSolver(std::span<ModuleSlot> modules, std::span<Link> links,
               const CouplingOptions& options);

  /// Returns the time reached [s]: `window.end`, or the event that ended the window before.
  /// Throws NumericalError when the iterations do not converge or a module reaches no time that
  /// lies in the window.
  double solve(const TimeWindow& window, const Iterations& iterations);

  /// After solve() threw: brings all modules back to `t` [s], where the window began, to be tried
  /// half as long. False where they were not saved.
  bool cut(double t);
  /// The same where the run ends there: nothing is tried again.
  void give_up(double t);

  /// The last window took no more than half of the passes it was allowed.
  bool was_easy() const { return was_easy_; }
  /// What changed, over the last window, of the values that a split held, over the size of what
  /// they stand for: the error that one pass leaves at the window's end. 0 with iterations.
  double held_back() const { return held_back_; }
  /// The link that holds most of what it sends; null where none does.
  const Link* holding_link() const { return holding_link_; }

  /// A lagged link whose prediction was seen to grow apart from the answer, over windows of one
  /// pass; null until then.
  const Link* unstable_link() const;

  /// After a state was restored: its points are those that the acceleration knows.
  void note_points();

  /// What the next windows are judged by.
  void visit_state(StateVisitor& visitor);

  /// The module that ended a window early last; empty: none has.
  const std::string& ended_by() const { return ended_by_; }

  const CouplingWork& work() const { return work_; }

 private:
  bool may_go_back(const Iterations& iterations) const;
  void find_held_back(const Iterations& iterations);
  /// Repeats passes until all lagged links agree; less than window.end after an event.
  double iterate(const TimeWindow& window, const Iterations& iterations);
  /// Asks all modules whether the window stands; less than window.end where one cuts it.
  double conclude(const TimeWindow& window, double reached);
  /// Every module once; stops at the first that ends early.
  double pass(const TimeWindow& window);
  double advance(ModuleSlot& slot, const TimeWindow& window);
  void predict(double length);
  void deliver_to(const ModuleSlot& slot);
  void collect_from(const ModuleSlot& slot, double length);
  void go_back(double t);

  bool is_settled() const;
  bool has_converged(double tolerance) const;
  /// What was predicted was so near that the first pass will do.
  bool is_enough_at_once(double tolerance) const;
  /// Fixes, for this window, the sizes that make the lagged links' values comparable.
  void weigh_links();
  double weighted_mismatch() const;
  /// Replaces what the lagged links send next.
  void accelerate(double length);
  /// Tells the acceleration which points have come since the last window, where others stayed.
  void follow_points();
  void watch(double length);
  [[noreturn]] void fail(double t, int passes, const char* problem) const;

  std::span<ModuleSlot> modules_;
  std::span<Link> links_;
  std::unique_ptr<Acceleration> acceleration_;
  bool may_cut_;
  bool is_saved_ = false;  ///< what begin_ holds is this window's beginning
  bool was_easy_ = true;
  double held_back_ = 0.0;
  const Link* holding_link_ = nullptr;
  std::string ended_by_;
  std::vector<SharedPoints> accelerated_;  ///< points of the lagged links' sources, one a link
  std::vector<double> weights_;            ///< one a link; of use for the lagged ones
  std::vector<StabilityWatch> watches_;    ///< likewise
  Snapshot begin_{/*takes_guesses=*/false};
  CouplingWork work_;
};

}  // namespace perifrac
