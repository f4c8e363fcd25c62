#include "coupling/window_solver.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "core/base/errors.hpp"

namespace perifrac {
namespace {

/// Tells a mismatch that grows for good from one that an acceleration swings, or that wanders at
/// the level of the integrators' own tolerance.
class GrowthWatch {
 public:
  bool is_diverging(double mismatch) {
    if (first_ < 0.0) first_ = mismatch;
    rises_ = mismatch > last_ ? rises_ + 1 : 0;
    last_ = mismatch;
    return (rises_ >= 5 && mismatch > first_) || !std::isfinite(mismatch);
  }

 private:
  double first_ = -1.0;
  double last_ = std::numeric_limits<double>::infinity();
  int rises_ = 0;
};

/// An event that moves back this often in one window is no event that a window can end at.
constexpr int most_redos = 50;

/// Where the old points lead the new ones; false where they have moved or some are gone.
bool leads(const PointSet& before, const PointSet& now) {
  if (now.count < before.count) return false;
  for (int axis = 0; axis < before.dimension; ++axis) {
    const auto begin = now.position[axis].first(before.count);
    if (!std::ranges::equal(before.position[axis], begin)) return false;
  }
  return true;
}

const PointSet& points_of(const Link& link) {
  return *link.source().module->port(link.source().port).points;
}

}  // namespace

WindowSolver::WindowSolver(std::span<ModuleSlot> modules, std::span<Link> links,
                           const CouplingOptions& options)
    : modules_(modules),
      links_(links),
      acceleration_(make_acceleration(options.acceleration)),
      may_cut_(options.retries > 0 && options.window == WindowType::schedule),
      watches_(links.size()) {}

double WindowSolver::solve(const TimeWindow& window, const Iterations& iterations) {
  is_saved_ = may_go_back(iterations);
  if (is_saved_) {
    const ProfilePart profiled("rollback");
    begin_.save([&](StateVisitor& visitor) { visit_modules(modules_, visitor); });
  }

  if (accelerated_.empty()) note_points();

  const std::int64_t passes_before = work_.passes;
  TimeWindow tried = window;
  if (is_saved_) {
    for (const ModuleSlot& slot : modules_)
      tried.end = std::min(tried.end, slot.module->expected_end(window));
  }
  double reached = conclude(tried, iterate(tried, iterations));
  for (int redone = 0; reached < tried.end; ++redone) {
    if (redone == most_redos)
      fail(reached, redone, "finds an earlier event each time the window is redone");
    go_back(tried.begin);
    tried.end = reached;
    reached = conclude(tried, iterate(tried, iterations));
  }
  if (reached < window.end) ++work_.events;
  find_held_back(iterations);
  for (Link& link : links_) link.accept();
  if (acceleration_->remembers()) follow_points();
  const std::int64_t passes = work_.passes - passes_before;
  const bool one_pass = iterations.max == 1 || (iterations.at_once > 0.0 && passes == 1);
  if (one_pass) watch(reached - window.begin);
  work_.most_passes = std::max(work_.most_passes, passes);
  was_easy_ = iterations.max == 1 || 2 * passes <= iterations.max;
  ++work_.windows;
  return reached;
}

void WindowSolver::find_held_back(const Iterations& iterations) {
  held_back_ = 0.0;
  holding_link_ = nullptr;
  for (const Link& link : links_) {
    if (iterations.max > 1 || !link.predicts() || !link.holds()) continue;
    if (link.mismatch().of_output() <= held_back_) continue;
    held_back_ = link.mismatch().of_output();
    holding_link_ = &link;
  }
}

bool WindowSolver::may_go_back(const Iterations& iterations) const {
  return may_cut_ || (iterations.max > 1 && std::ranges::any_of(links_, &Link::predicts)) ||
         std::ranges::any_of(modules_,
                             [](const ModuleSlot& slot) { return slot.module->may_end_windows(); });
}

bool WindowSolver::cut(double t) {
  if (!is_saved_) return false;
  go_back(t);
  acceleration_->reset();
  ++work_.cuts;
  return true;
}

void WindowSolver::give_up(double t) {
  if (is_saved_) go_back(t);
}

double WindowSolver::conclude(const TimeWindow& window, double reached) {
  for (ModuleSlot& slot : modules_) {
    if (reached < window.end) return reached;
    const ModuleTime counted(slot);
    const ProfileScope profiled("window's end");
    reached = slot.module->conclude(window);
    if (reached < window.end) ended_by_ = slot.name;
  }
  return reached;
}

double WindowSolver::iterate(const TimeWindow& window, const Iterations& iterations) {
  for (ModuleSlot& slot : modules_) {
    const ProfilePart profiled(slot.name);
    slot.module->prepare(window);
  }
  predict(window.length());
  acceleration_->begin_window();
  GrowthWatch watch;
  for (int passes = 1;; ++passes) {
    const double reached = pass(window);
    if (reached < window.end || iterations.max == 1 || has_converged(iterations.tolerance)) {
      return reached;
    }
    if (passes == 1 && is_enough_at_once(iterations.at_once)) return reached;
    if (passes == 1) weigh_links();
    if (!is_settled()) {
      // Modules change what they answer: what was learned of it is of no use.
      acceleration_->begin_window();
      watch = {};
    } else if (watch.is_diverging(weighted_mismatch())) {
      fail(window.end, passes, "diverges");
    }
    if (passes == iterations.max) fail(window.end, passes, "does not converge");
    accelerate(window.length());
    go_back(window.begin);
  }
}

double WindowSolver::pass(const TimeWindow& window) {
  ++work_.passes;
  for (ModuleSlot& slot : modules_) {
    deliver_to(slot);
    const double reached = advance(slot, window);
    if (reached < window.end) {
      ended_by_ = slot.name;
      return reached;
    }
    collect_from(slot, window.length());
  }
  return window.end;
}

double WindowSolver::advance(ModuleSlot& slot, const TimeWindow& window) {
  const ModuleTime counted(slot);
  ++slot.advances;
  const double reached = slot.module->advance(window);
  const bool moved = reached > window.begin || window.length() == 0.0;
  if (!moved || !(reached >= window.begin && reached <= window.end)) {
    throw NumericalError(
        "time", slot.name, window.begin,
        fmt::format("asked for t = {:.6g} s, the module reached {:.6g} s", window.end, reached));
  }
  return reached;
}

void WindowSolver::predict(double length) {
  const ProfilePart profiled("exchange");
  for (Link& link : links_) link.predict(length);
}

void WindowSolver::deliver_to(const ModuleSlot& slot) {
  const ProfilePart profiled("exchange");
  for (Link& link : links_) {
    if (link.target().module == slot.module.get()) link.deliver();
  }
}

void WindowSolver::collect_from(const ModuleSlot& slot, double length) {
  const ProfilePart profiled("exchange");
  for (Link& link : links_) {
    if (link.source().module == slot.module.get()) link.collect(length);
  }
}

void WindowSolver::go_back(double t) {
  const ProfilePart profiled("rollback");
  begin_.restore([&](StateVisitor& visitor) { visit_modules(modules_, visitor); });
  for (ModuleSlot& slot : modules_) slot.module->on_restored(t);
}

bool WindowSolver::is_settled() const {
  return std::ranges::none_of(
      modules_, [](const ModuleSlot& slot) { return slot.module->wants_another_pass(); });
}

bool WindowSolver::has_converged(double tolerance) const {
  if (!is_settled()) return false;
  for (const Link& link : links_) {
    if (link.predicts() && !(link.mismatch().relative() <= tolerance)) return false;
  }
  return true;
}

bool WindowSolver::is_enough_at_once(double tolerance) const {
  return tolerance > 0.0 && is_settled() &&
         std::ranges::all_of(links_, [tolerance](const Link& link) {
           return !link.predicts() || !link.uses_slope() || link.mismatch().relative() <= tolerance;
         });
}

void WindowSolver::watch(double length) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].predicts()) watches_[i].look(links_[i].mismatch(), length);
  }
}

const Link* WindowSolver::unstable_link() const {
  const auto found = std::ranges::find_if(watches_, &StabilityWatch::has_found_growth);
  return found == watches_.end() ? nullptr
                                 : &links_[static_cast<std::size_t>(found - watches_.begin())];
}

void WindowSolver::visit_state(StateVisitor& visitor) {
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const Link& link = links_[i];
    if (!link.lagged()) continue;
    visitor.enter(link.state_name());
    watches_[i].visit_state(visitor);
    visitor.leave();
  }
  visitor.enter("acceleration");
  acceleration_->visit_state(visitor);
  visitor.leave();
}

void WindowSolver::weigh_links() {
  weights_.clear();
  for (const Link& link : links_) {
    const double size = std::max(link.mismatch().scale, link.mismatch().absolute);
    weights_.push_back(size > 0.0 ? 1.0 / size : 1.0);
  }
}

double WindowSolver::weighted_mismatch() const {
  double sum = 0.0;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    const double mismatch = weights_[i] * links_[i].mismatch().absolute;
    if (links_[i].predicts()) sum += mismatch * mismatch;
  }
  return std::sqrt(sum);
}

void WindowSolver::accelerate(double length) {
  Eigen::Index size = 0;
  for (const Link& link : links_) {
    if (link.predicts()) size += static_cast<Eigen::Index>(link.answer().size());
  }
  Eigen::VectorXd used(size);
  Eigen::VectorXd answer(size);
  Eigen::VectorXd scale(size);
  Eigen::Index at = 0;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].predicts()) continue;
    for (std::size_t j = 0; j < links_[i].answer().size(); ++j, ++at) {
      used[at] = links_[i].used()[j];
      answer[at] = links_[i].answer()[j];
      scale[at] = weights_[i];
    }
  }
  const Eigen::VectorXd next = acceleration_->next(used, answer, scale);
  at = 0;
  std::vector<double> values;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].predicts()) continue;
    values.resize(links_[i].answer().size());
    for (double& value : values) value = next[at++];
    links_[i].relax(values, length);
  }
}

void WindowSolver::note_points() {
  if (!acceleration_->remembers()) return;
  accelerated_.resize(links_.size());
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (links_[i].predicts()) accelerated_[i] = freeze(points_of(links_[i]), accelerated_[i]);
  }
}

void WindowSolver::follow_points() {
  std::vector<Eigen::Index> kept;
  Eigen::Index size = 0;
  bool are_known = true, have_come = false;
  for (std::size_t i = 0; i < links_.size(); ++i) {
    if (!links_[i].predicts()) continue;
    const PointSet& now = points_of(links_[i]);
    const SharedPoints before = std::exchange(accelerated_[i], freeze(now, accelerated_[i]));
    const PointSet& old = before->set();
    have_come = have_come || !old.same_points(now);
    are_known = are_known && (old.same_points(now) || leads(old, now));
    const LinkEnd& source = links_[i].source();
    const auto components =
        static_cast<Eigen::Index>(source.module->ports()[source.port].components);
    for (Eigen::Index j = 0; j < components * static_cast<Eigen::Index>(old.count); ++j)
      kept.push_back(size + j);
    size += components * static_cast<Eigen::Index>(now.count);
  }
  if (!are_known) return acceleration_->reset();
  if (have_come) acceleration_->follow(kept, size);
}

void WindowSolver::fail(double t, int passes, const char* problem) const {
  const Link* worst = nullptr;
  for (const Link& link : links_) {
    if (!link.predicts()) continue;
    if (!worst || !(link.mismatch().relative() <= worst->mismatch().relative())) worst = &link;
  }
  std::string strength;
  for (const CoupledPair& pair : coupled_pairs(links_)) {
    const Link& first = links_[pair.first];
    const Link& second = links_[pair.second];
    const double value = coupling_strength(first, second);
    if ((&first == worst || &second == worst) && value > 0.0) {
      strength = fmt::format(", coupling strength {:.3g}", value);
    }
  }
  throw NumericalError(
      worst ? worst->name() : "time", worst ? worst->path() : "the modules", t,
      fmt::format("the coupling {} ({} tries, relative mismatch {:.2e}{})", problem, passes,
                  worst ? worst->mismatch().relative() : 0.0, strength));
}

}  // namespace perifrac
