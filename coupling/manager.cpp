#include "coupling/manager.hpp"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "coupling/connect.hpp"

namespace perifrac {
namespace {

/// A window of no length is cheap and rare, and its error would stay in all that follows.
constexpr Iterations settling{.max = 500, .tolerance = 1e-10};

}  // namespace

CouplingManager::CouplingManager(std::vector<ModuleSlot> modules, const CouplingOptions& options)
    : options_(options),
      modules_(std::move(modules)),
      ledger_(modules_),
      schedule_(options.window, options.first_window, options.window_growth,
                options.largest_window) {}

void CouplingManager::initialize(double t) {
  for (ModuleSlot& slot : modules_) {
    const ModuleTime counted(slot);
    slot.module->initialize(t);
  }
  links_ = connect(modules_, options_.split);
  for (Link& link : links_) link.start();
  if (std::ranges::any_of(links_, &Link::is_foretold)) {
    options_.window = WindowType::one_step;
    schedule_ = WindowSchedule(options_.window, options_.first_window, options_.window_growth,
                               options_.largest_window);
  }
  solver_ = std::make_unique<WindowSolver>(modules_, links_, options_.acceleration);
  ledger_.start();
  time_ = t;
  step_ = 0;
}

bool CouplingManager::split_is_unusable() const {
  const auto pairs = coupled_pairs(links_);
  return options_.split != Split::drained && !pairs.empty() &&
         std::ranges::none_of(pairs, [&](const CoupledPair& pair) {
           return links_[pair.first].uses_slope() || links_[pair.second].uses_slope();
         });
}

/// Fixed stress on extrapolated inputs, once a window: measured, it holds at a strength of 8 and
/// fails at 17.
std::vector<std::string> CouplingManager::one_pass_warnings() const {
  constexpr double limit = 10.0;
  std::vector<std::string> warnings;
  if (options_.max_iterations > 1) return warnings;
  for (const CoupledPair& pair : coupled_pairs(links_)) {
    const Link& first = links_[pair.first];
    const Link& second = links_[pair.second];
    const double strength = coupling_strength(first, second);
    if (strength < limit || !(first.uses_slope() || second.uses_slope())) continue;
    warnings.push_back(fmt::format(
        "one pass a window may not hold: the coupling strength of {} and {} is {:.3g}; choose "
        "coupling.iterations.max: 20",
        first.path(), second.path(), strength));
  }
  return warnings;
}

std::vector<std::string> CouplingManager::warnings() const {
  if (options_.split != Split::drained) return one_pass_warnings();
  std::vector<std::string> warnings;
  // Plain iteration multiplies an error by the strength s in each pass. One pass a window, on
  // linearly extrapolated inputs, multiplies it by the roots of r^2 + 2 s r - s = 0, of which one
  // leaves the unit circle at s = 1/3.
  const bool one_pass = options_.max_iterations == 1;
  const double limit = one_pass ? 1.0 / 3.0 : 1.0;
  for (const CoupledPair& pair : coupled_pairs(links_)) {
    const Link& first = links_[pair.first];
    const Link& second = links_[pair.second];
    const double strength = coupling_strength(first, second);
    if (strength == 0.0) {
      warnings.push_back(fmt::format(
          "split `drained` is likely to diverge: a window of {} and {} leaves out how the one "
          "answers the other's inertia; choose `split: undrained`",
          first.path(), second.path()));
    }
    if (strength < limit) continue;
    warnings.push_back(fmt::format(
        "split `drained` is likely to diverge: the coupling strength of {} and {} is {:.3g}, and "
        "{} grows where that exceeds {:.3g}; choose `split: fixed_stress`",
        first.path(), second.path(), strength,
        one_pass ? "over one-pass windows an error" : "from pass to pass an error", limit));
  }
  return warnings;
}

void CouplingManager::settle() {
  solver_->solve({time_, time_}, settling);
  schedule_.start_over(stable_time_step());
}

double CouplingManager::advance(double stop) {
  const double end = schedule_.end(time_, stop);
  time_ = solver_->solve({time_, end}, {options_.max_iterations, options_.tolerance});
  ++step_;
  if (time_ == end) schedule_.grow(stable_time_step());
  return time_;
}

std::optional<std::string> CouplingManager::new_warning() {
  const Link* const link = solver_->unstable_link();
  if (link == nullptr || has_warned_) return std::nullopt;
  has_warned_ = true;
  return fmt::format(
      "one pass a window is not stable: what is predicted of {} is off by more than the values "
      "that were there, and further in every window; choose coupling.iterations.max: 20",
      link->path());
}

void CouplingManager::restart_point() {
  for (ModuleSlot& slot : modules_) slot.module->on_restored(time_);
}

void CouplingManager::visit_state(StateVisitor& visitor) {
  visit_modules(modules_, visitor);
  visitor.enter("coupling");
  visitor.visit("time", time_);
  visitor.visit("step", step_);
  schedule_.visit_state(visitor);
  ledger_.visit_state(visitor);
  for (Link& link : links_) link.visit_state(visitor);
  visitor.leave();
}

double CouplingManager::stable_time_step() const {
  double step = std::numeric_limits<double>::infinity();
  if (options_.window != WindowType::one_step) return step;
  for (const ModuleSlot& slot : modules_) step = std::min(step, slot.module->stable_time_step());
  return step;
}

}  // namespace perifrac
