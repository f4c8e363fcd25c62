#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/base/errors.hpp"
#include "core/state/state_visitor.hpp"
#include "coupling/coupling_options.hpp"
#include "coupling/ledger.hpp"
#include "coupling/link.hpp"
#include "coupling/module_slot.hpp"
#include "coupling/stall_watch.hpp"
#include "coupling/window_schedule.hpp"
#include "coupling/window_solver.hpp"

namespace perifrac {

/// Owns the modules and moves them through time together. Use: initialize, warnings, settle, then
/// advance until the end; to restart: initialize, visit_state with what was saved, restart_point.
class CouplingManager {
 public:
  /// `modules` in the order in which they advance within a window, each of another name.
  CouplingManager(std::vector<ModuleSlot> modules, const CouplingOptions& options);
  CouplingManager(const CouplingManager&) = delete;  // links point at the modules
  CouplingManager& operator=(const CouplingManager&) = delete;

  /// Initialises every module at time `t` [s] and connects their ports.
  /// Throws std::logic_error where ports do not fit.
  void initialize(double t);

  /// True where modules depend on each other and none of them can use the split that was asked for.
  bool split_is_unusable() const;

  /// For which one pass a window on extrapolated inputs may not hold.
  std::vector<CoupledPair> pairs_too_strong_for_one_pass() const;

  /// What will probably fail, one sentence each, from the state as initialised.
  std::vector<std::string> warnings() const;

  /// The instant answer to a load that came on suddenly: a window of no length, iterated until the
  /// modules agree whatever the scene's iterations. Windows start over from the first. Returns the
  /// share of energy that this sets free (Ledger::settle). Throws NumericalError.
  double settle();

  /// Advances over one window, not past `stop` [s]; returns the time reached. A window that fails
  /// is taken back and tried again, half as long, as often as the scene lets it; the log says why.
  /// Throws NumericalError, also where windows become ever shorter.
  double advance(double stop);

  /// Said once, when windows of one pass are seen not to be stable; nothing otherwise.
  std::optional<std::string> new_warning();

  /// Windows of one pass were seen not to be stable: shorter ones would make it worse.
  bool is_unstable() const { return solver_->unstable_link() != nullptr; }

  /// From here a run that was saved now, and restored, goes on bit for bit as this one does: both
  /// call this after saving or restoring. Every module drops what it derived from the past; inputs,
  /// which are no one's state, are written again: slopes at once, since modules may hold energy by
  /// them, all else by the next window.
  void restart_point();

  /// All modules' fields as `<module>/<field>` and the manager's own as `coupling/<field>`.
  void visit_state(StateVisitor& visitor);

  double time() const { return time_; }  ///< [s]
  const WindowSchedule& schedule() const { return schedule_; }
  /// The shortest of the modules' own; infinity where no window asks for it [s].
  double stable_time_step() const;
  std::int64_t step() const { return step_; }  ///< windows since the start, restarts included
  std::span<const ModuleSlot> modules() const { return modules_; }
  std::span<const Link> links() const { return links_; }
  const Ledger& ledger() const { return ledger_; }
  int most_passes() const { return iterations_.max; }  ///< that a window may take
  const CouplingWork& work() const { return solver_->work(); }

 private:
  void start_links();
  void let_modules_see_slopes();
  void predict_no_change();
  /// Half of the window that began at time() and was to reach `end` is left; returns its end.
  double cut(double end, double stop, const NumericalError& error);
  /// What a run says that no longer gets on; `cut` is what the last window was cut for, or null.
  NumericalError stalled(double whole, const NumericalError* cut) const;
  void choose_next_window();
  /// How often windows are repeated where the scene leaves it open.
  Iterations own_iterations() const;
  std::vector<std::string> one_pass_warnings() const;
  std::vector<std::string> iteration_warnings() const;

  CouplingOptions options_;
  std::vector<ModuleSlot> modules_;
  std::vector<Link> links_;
  Ledger ledger_;
  WindowSchedule schedule_;
  Iterations iterations_;
  std::unique_ptr<WindowSolver> solver_;  ///< once the links are known
  StallWatch stall_;
  double time_ = 0.0;
  std::int64_t step_ = 0;
  bool has_warned_ = false;
  bool has_shortened_ = false;
};

}  // namespace perifrac
