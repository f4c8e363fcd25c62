#include "coupling/manager.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/io/log.hpp"
#include "coupling/connect.hpp"

namespace perifrac {
namespace {

/// A window of no length is cheap and rare, and its error would stay in all that follows.
constexpr Iterations settling{.max = 500, .tolerance = 1e-10};

/// Smooth fields take five to ten of them, sharp ones in nearly undrained rock the most.
constexpr int enough_passes = 100;

}  // namespace

CouplingManager::CouplingManager(std::vector<ModuleSlot> modules, const CouplingOptions& options)
    : options_(options),
      modules_(std::move(modules)),
      ledger_(modules_),
      schedule_(options.window, options.first_window, options.window_growth,
                options.largest_window),
      iterations_{options.max_iterations.value_or(1), options.tolerance} {}

void CouplingManager::initialize(double t) {
  for (ModuleSlot& slot : modules_) {
    const ModuleTime counted(slot);
    slot.module->initialize(t);
  }
  start_links();
  if (std::ranges::any_of(links_, &Link::is_foretold)) {
    options_.window = WindowType::one_step;
    schedule_ = WindowSchedule(options_.window, options_.first_window, options_.window_growth,
                               options_.largest_window);
  }
  time_ = t;
  let_modules_see_slopes();
  if (!options_.max_iterations) iterations_ = own_iterations();
  if (iterations_.max == 1 && options_.split != Split::drained) predict_no_change();
  solver_ = std::make_unique<WindowSolver>(modules_, links_, options_);
  ledger_.start();
  step_ = 0;
}

void CouplingManager::start_links() {
  const ProfilePart profiled("exchange");
  links_ = connect(modules_, options_.split);
  for (Link& link : links_) link.start();
  for (const Link& link : links_) {
    const Port& port = link.target().module->ports()[link.target().port];
    if (link.is_first_of_sum() && port.components == 1) {
      ledger_.show(port.name, port.unit, link.sum());
    }
  }
}

/// How they store may depend on how strongly they are answered within a window.
void CouplingManager::let_modules_see_slopes() {
  for (Link& link : links_) {
    if (!link.uses_slope() || link.holds()) continue;
    link.predict(0.0);
    link.deliver();
    link.target().module->prepare({time_, time_});
  }
}

/// Linear extrapolation would feed the error of every window into the next.
void CouplingManager::predict_no_change() {
  for (const CoupledPair& pair : pairs_too_strong_for_one_pass()) {
    for (const std::size_t link : {pair.first, pair.second}) {
      if (links_[link].predicts() && links_[link].uses_slope()) links_[link].predict_no_change();
    }
  }
}

bool CouplingManager::split_is_unusable() const {
  const auto pairs = coupled_pairs(links_);
  return options_.split != Split::drained && !pairs.empty() &&
         std::ranges::none_of(pairs, [&](const CoupledPair& pair) {
           return links_[pair.first].uses_slope() || links_[pair.second].uses_slope();
         });
}

/// Fixed stress mends what was foretold wrongly, by a jump or in a window too long: all that is
/// smooth is foretold to 1e-2. An undrained split, and windows of one step, stay as they are.
Iterations CouplingManager::own_iterations() const {
  constexpr double foretold = 0.03;
  if (!pairs_too_strong_for_one_pass().empty()) return {enough_passes, options_.tolerance};
  const bool can = std::ranges::any_of(links_, [](const Link& link) {
    return link.predicts() && link.uses_slope() && !link.holds();
  });
  if (!can || options_.window == WindowType::one_step) return {1, options_.tolerance};
  return {enough_passes, options_.tolerance, foretold};
}

/// Fixed stress on extrapolated inputs, once a window. A pass leaves at most s / (1 + s) of an
/// error where the strength is s; where that is above 0.763, windows of about a tenth of dx^2/c let
/// pressures that vary from point to point grow (docs/decisions/0017).
std::vector<CoupledPair> CouplingManager::pairs_too_strong_for_one_pass() const {
  constexpr double limit = 3.0;
  std::vector<CoupledPair> pairs = coupled_pairs(links_);
  std::erase_if(pairs, [&](const CoupledPair& pair) {
    const Link& first = links_[pair.first];
    const Link& second = links_[pair.second];
    return !(first.uses_slope() || second.uses_slope()) || coupling_strength(first, second) < limit;
  });
  return pairs;
}

/// What is held answers the vibrations of an explicit solid once a window; iterated, sub-steps of
/// forward Euler answer them ahead of time, and feed them.
std::vector<std::string> CouplingManager::iteration_warnings() const {
  const auto feeds = std::ranges::find_if(links_, [](const Link& link) {
    return link.holds() && std::isfinite(link.source().module->stable_time_step());
  });
  if (iterations_.max == 1 || feeds == links_.end()) return {};
  return {fmt::format(
      "iterating {} may let vibrations grow without bound, for {} takes explicit sub-steps; choose "
      "coupling.iterations.max: 1, whose windows are kept short enough, or an implicit integrator",
      feeds->path(), feeds->source().module_name)};
}

std::vector<std::string> CouplingManager::one_pass_warnings() const {
  if (auto warnings = iteration_warnings(); !warnings.empty()) return warnings;
  const auto pairs = pairs_too_strong_for_one_pass();
  if (iterations_.max > 1 || pairs.empty()) return {};
  const Link& first = links_[pairs[0].first];
  const Link& second = links_[pairs[0].second];
  return {fmt::format(
      "one pass a window is of first order only: the coupling strength of {} and {} is {:.3g}, and "
      "above 3 an extrapolated input would feed its error; leave coupling.iterations.max out, or "
      "choose {}",
      first.path(), second.path(), coupling_strength(first, second), enough_passes)};
}

std::vector<std::string> CouplingManager::warnings() const {
  if (options_.split != Split::drained) return one_pass_warnings();
  std::vector<std::string> warnings;
  // Plain iteration multiplies an error by the strength s in each pass. One pass a window, on
  // linearly extrapolated inputs, multiplies it by the roots of r^2 + 2 s r - s = 0, of which one
  // leaves the unit circle at s = 1/3.
  const bool one_pass = iterations_.max == 1;
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

double CouplingManager::settle() {
  solver_->solve({time_, time_}, settling);
  schedule_.start_over(stable_time_step());
  return ledger_.settle();
}

double CouplingManager::advance(double stop) {
  const double whole = std::min(schedule_.whole(), stop - time_);
  std::optional<NumericalError> last_cut;
  double end = schedule_.end(time_, stop);
  double reached = 0.0;
  for (int retries = 0;; ++retries) {
    try {
      reached = solver_->solve({time_, end}, iterations_);
      break;
    } catch (const FinalError&) {
      throw;
    } catch (const NumericalError& error) {
      if (retries == options_.retries) solver_->give_up(time_);
      if (retries == options_.retries || !solver_->cut(time_)) throw;
      end = cut(end, stop, error);
      last_cut = error;
      if (end - time_ < StallWatch::shortest * whole) throw stalled(whole, &error);
    }
  }
  const bool is_stalled = stall_.finds_stall(reached - time_, whole);
  time_ = reached;
  if (is_stalled) throw stalled(whole, last_cut ? &*last_cut : nullptr);
  ++step_;
  if (time_ == end) choose_next_window();
  return time_;
}

/// An undrained split in one pass holds what it sends over a window. What that should have changed
/// by is off at the window's end, and falls with its length.
void CouplingManager::choose_next_window() {
  constexpr double most = 0.02, room = 1.5;  // of what is held
  const double held_back = solver_->held_back();
  const bool can = options_.window == WindowType::schedule && options_.retries > 0;
  if (can && held_back > most) {
    schedule_.shorten(std::max(0.5, most / held_back), std::pow(0.5, options_.retries));
    if (!has_shortened_) {
      log_info(
          fmt::format("windows from t = {:.6g} s on are shorter than coupling.window says: in one "
                      "pass {:.2g} of {} changed unseen",
                      time_, held_back, solver_->holding_link()->path()));
    }
    has_shortened_ = true;
    return;
  }
  schedule_.grow(stable_time_step(), solver_->was_easy() && room * held_back <= most);
}

double CouplingManager::cut(double end, double stop, const NumericalError& error) {
  constexpr std::int64_t most_told = 20;
  schedule_.cut(end - time_);
  const std::int64_t cuts = solver_->work().cuts;
  if (cuts <= most_told) {
    log_warning(fmt::format("the window from t = {:.6g} s is cut from {:.3g} s to half of it: {}",
                            time_, end - time_, error.what()));
  }
  if (cuts == most_told) log_warning("further cuts are only counted, in summary.json");
  return schedule_.end(time_, stop);
}

NumericalError CouplingManager::stalled(double whole, const NumericalError* cut) const {
  const std::string field = cut ? cut->field() : "time";
  const std::string place = cut ? cut->place() : solver_->ended_by();
  std::string cause = "an event in each";
  if (cut) cause = cut->what(), cause.resize(cause.find(" in " + field + " at " + place));
  return {field, place, time_,
          fmt::format("windows become ever shorter, where {:.3g} s was asked for, by: {}; let what "
                      "changes there come on more slowly (a schedule), or choose another "
                      "body.spacing: no progress",
                      whole, cause)};
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
  let_modules_see_slopes();
  solver_->note_points();
}

void CouplingManager::visit_state(StateVisitor& visitor) {
  visit_modules(modules_, visitor);
  visitor.enter("coupling");
  visitor.visit("time", time_);
  visitor.visit("step", step_);
  schedule_.visit_state(visitor);
  ledger_.visit_state(visitor);
  for (Link& link : links_) link.visit_state(visitor);
  solver_->visit_state(visitor);
  visitor.leave();
}

double CouplingManager::stable_time_step() const {
  double step = std::numeric_limits<double>::infinity();
  if (options_.window != WindowType::one_step) return step;
  for (const ModuleSlot& slot : modules_) {
    const ProfilePart profiled(slot.name);
    step = std::min(step, slot.module->stable_time_step());
  }
  return step;
}

}  // namespace perifrac
