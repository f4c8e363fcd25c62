#include "app/run/forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/run/memory.hpp"
#include "core/base/errors.hpp"
#include "core/base/ranks.hpp"
#include "coupling/processor_time.hpp"

namespace perifrac {

namespace {

using Clock = std::chrono::steady_clock;

/// A trial goes on until cracks that are to grow have gained so many facets, which tell what one
/// costs, or where it has come so far that little is left; but not longer than this times its time.
constexpr double telling_facets = 10, far = 0.1, longest_wait = 3;

double since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// A window of the trial.
struct Trial {
  double length;                ///< [s]
  std::vector<double> seconds;  ///< in every module, and in what couples them
  Index facets;                 ///< that cracks gained in it
};

/// Wall time in every module so far, and in all.
std::vector<double> spent(const CouplingManager& manager, Clock::time_point begin) {
  std::vector<double> seconds;
  for (const ModuleSlot& slot : manager.modules()) seconds.push_back(slot.seconds);
  seconds.push_back(since(begin));
  return seconds;
}

/// Since `before`; the last entry becomes what is not in the modules.
std::vector<double> spent_since(std::span<const double> before, std::vector<double> now) {
  for (std::size_t k = 0; k < now.size(); ++k) now[k] -= before[k];
  for (std::size_t k = 0; k + 1 < now.size(); ++k) now.back() -= now[k];
  return now;
}

/// How many steps a part takes in a window: one, or as many as a module's own stable step asks for.
std::vector<double> steps_in(const CouplingManager& manager, double length) {
  std::vector<double> steps;
  for (const ModuleSlot& slot : manager.modules()) {
    steps.push_back(std::max(1.0, length / slot.module->stable_time_step()));
  }
  steps.push_back(1.0);
  return steps;
}

/// What a step and a facet cost every part [s].
struct Cost {
  std::vector<double> step;
  std::vector<double> facet;
};

/// Means over windows in which no crack grew, and over all where there is no such window or it is
/// not known how far cracks will grow; a facet costs what the others took more.
Cost cost_of(const CouplingManager& manager, std::span<const Trial> trial, bool knows_facets) {
  const std::size_t parts = manager.modules().size() + 1;
  const bool apart =
      knows_facets && std::ranges::any_of(trial, [](const Trial& w) { return w.facets == 0; });
  std::vector<double> seconds(parts, 0.0), steps(parts, 0.0);
  for (const Trial& window : trial) {
    if (apart && window.facets > 0) continue;
    const std::vector<double> taken = steps_in(manager, window.length);
    for (std::size_t k = 0; k < parts; ++k) {
      seconds[k] += window.seconds[k];
      steps[k] += taken[k];
    }
  }
  Cost cost;
  for (std::size_t k = 0; k < parts; ++k) {
    cost.step.push_back(steps[k] > 0.0 ? seconds[k] / steps[k] : 0.0);
  }
  cost.facet.resize(parts);
  double facets = 0.0;
  for (const Trial& window : trial) {
    if (!apart || window.facets == 0) continue;
    facets += window.facets;
    const std::vector<double> taken = steps_in(manager, window.length);
    for (std::size_t k = 0; k < parts; ++k) {
      cost.facet[k] += window.seconds[k] - cost.step[k] * taken[k];
    }
  }
  for (double& cost_of_one : cost.facet) {
    cost_of_one = facets > 0.0 ? std::max(0.0, cost_of_one / facets) : 0.0;
  }
  return cost;
}

/// The shortest of any module [s]; infinite where none has its own.
double shortest_step(const CouplingManager& manager) {
  double step = std::numeric_limits<double>::infinity();
  for (const ModuleSlot& slot : manager.modules()) {
    step = std::min(step, slot.module->stable_time_step());
  }
  return step;
}

/// Windows are cut short in a trial, so that one of very many steps does not go on long after it.
class Reach {
 public:
  explicit Reach(const CouplingManager& manager) : manager_(manager) {}

  /// How far the next window may go [s of the scene], with so many seconds left.
  double next(double left) const {
    const double steps = cost_ > 0.0 ? std::min(growth * steps_, left / cost_) : first_steps;
    return manager_.time() + std::max(first_steps, steps) * shortest_step(manager_);
  }

  void took(double seconds, double length) {
    steps_ = std::max(first_steps, length / shortest_step(manager_));
    cost_ = seconds / steps_;
  }

 private:
  static constexpr double first_steps = 20.0, growth = 4.0;

  const CouplingManager& manager_;
  double steps_ = 0.0, cost_ = 0.0;  ///< of the last window; of a step of it [s]
};

/// Windows that nothing cuts, from where the simulation stands to the last output.
template <class Use>
void for_each_window_to_come(const CouplingManager& manager, std::span<const double> outputs,
                             Use&& use) {
  WindowSchedule schedule = manager.schedule();
  const double stable = manager.stable_time_step();
  double t = manager.time();
  for (const double output : outputs) {
    while (t < output) {
      const double end = schedule.end(t, output);
      use(end - t);
      t = end;
      schedule.grow(stable);
    }
  }
}

/// The first windows of a run, and what they took.
class TrialRun {
 public:
  TrialRun(Simulation& simulation, double seconds, std::optional<double> facets_at_end)
      : simulation_(simulation),
        manager_(*simulation.manager),
        seconds_(seconds),
        facets_to_come_(facets_at_end.value_or(0.0) - facet_count(simulation)),
        facets_at_start_(facet_count(simulation)),
        at_start_(spent(manager_, begin_)) {}

  /// Until enough is known, up to the last of the outputs at most. Throws NumericalError.
  void run(std::span<const double> outputs) {
    Reach reach(manager_);
    manager_.settle();
    while (reached_ < outputs.size() && goes_on(outputs.back())) {
      const double output = outputs[reached_], t = manager_.time(), used = used_processor_time();
      const Index facets = facet_count(simulation_);
      const std::vector<double> before = spent(manager_, begin_);
      manager_.advance(std::min(output, reach.next(seconds_ - used)));
      reach.took(used_processor_time() - used, manager_.time() - t);
      windows_.push_back({manager_.time() - t, spent_since(before, spent(manager_, begin_)),
                          facet_count(simulation_) - facets});
      if (manager_.time() != output) continue;
      manager_.restart_point();  // as a run does
      ++reached_;
    }
  }

  /// Outputs that were reached.
  std::size_t reached() const { return reached_; }
  std::span<const Trial> windows() const { return windows_; }
  double wall_time() const { return since(begin_); }  ///< [s]
  /// By the first process, so that all go on as long.
  double used_processor_time() const {
    return ranks::of_first(processor_time() - processors_before_);
  }
  /// Every part, and what couples them [s].
  std::vector<double> seconds_by_part() const {
    return spent_since(at_start_, spent(manager_, begin_));
  }

 private:
  bool goes_on(double end) const {
    if (windows_.empty()) return true;  // nothing can be foretold from no window
    const Index gained = facet_count(simulation_) - facets_at_start_;
    const bool waits =
        gained < std::min<double>(telling_facets, facets_to_come_) || manager_.time() > far * end;
    return used_processor_time() < (waits ? longest_wait : 1.0) * seconds_;
  }

  Simulation& simulation_;
  CouplingManager& manager_;
  double seconds_;
  double facets_to_come_;
  Index facets_at_start_;
  Clock::time_point begin_ = Clock::now();
  double processors_before_ = processor_time();
  std::vector<double> at_start_;
  std::vector<Trial> windows_;
  std::size_t reached_ = 0;
};

/// Adds to the parts of a trial what the rest of the run will take; returns its windows.
std::int64_t add_the_rest(const CouplingManager& manager, std::span<const Trial> trial,
                          std::span<const double> outputs, std::optional<double> facets_to_come,
                          std::vector<double>& parts) {
  std::int64_t windows = 0;
  // What the first windows take is of their own: caches fill, iterations find their pace.
  const Cost cost = cost_of(manager, trial.subspan(trial.size() / 2), facets_to_come.has_value());
  for_each_window_to_come(manager, outputs, [&](double length) {
    const std::vector<double> steps = steps_in(manager, length);
    for (std::size_t k = 0; k < parts.size(); ++k) parts[k] += cost.step[k] * steps[k];
    ++windows;
  });
  const double facets = facets_to_come.value_or(0.0);
  // A facet costs half a window of its own, too: growth ends the one that it comes in, anywhere.
  for (std::size_t k = 0; k < parts.size(); ++k) {
    parts[k] += (0.5 * cost.step[k] + cost.facet[k]) * facets;
  }
  return windows + std::llround(0.5 * facets);
}

}  // namespace

Forecast forecast(Simulation& simulation, std::span<const double> outputs, double trial_seconds,
                  double building_seconds, std::optional<double> facets_at_end) {
  CouplingManager& manager = *simulation.manager;
  Forecast result{};
  TrialRun trial(simulation, trial_seconds, facets_at_end);
  try {
    trial.run(outputs);
  } catch (const NumericalError& error) {
    result.failure = error.what();
  }
  result.trial_time = manager.time();
  result.trial_seconds = trial.wall_time();
  result.is_whole = trial.reached() == outputs.size();
  result.windows = manager.step();

  std::vector<double> parts = trial.seconds_by_part();
  if (!result.is_whole && !result.failure) {
    std::optional<double> facets;
    if (facets_at_end) facets = std::max(0.0, *facets_at_end - facet_count(simulation));
    result.windows += add_the_rest(manager, trial.windows(), outputs, facets, parts);
  }
  // As if nothing else ran: one thread is then never kept waiting.
  const double quiet = std::min(1.0, trial.used_processor_time() / result.trial_seconds);
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool is_module = k < manager.modules().size();
    result.seconds_by_part.emplace_back(is_module ? manager.modules()[k].name : "coupling",
                                        parts[k]);
  }
  result.seconds_by_part.emplace_back("building", building_seconds);
  for (auto& [name, seconds] : result.seconds_by_part) {
    seconds *= quiet;
    result.seconds += seconds;
  }
  result.memory = peak_memory();
  return result;
}

}  // namespace perifrac
