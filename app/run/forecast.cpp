#include "app/run/forecast.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "app/run/summary.hpp"
#include "core/base/errors.hpp"
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

Index facet_count(const Simulation& simulation) {
  return std::visit(
      [](const auto& body) {
        return body ? static_cast<Index>(body->bond_state().facets().size()) : Index{0};
      },
      simulation.body);
}

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

/// Means over windows in which no crack grew; a facet costs what the others took more.
Cost cost_of(const CouplingManager& manager, std::span<const Trial> trial) {
  const std::size_t parts = manager.modules().size() + 1;
  std::vector<double> seconds(parts, 0.0), steps(parts, 0.0);
  for (const Trial& window : trial) {
    if (window.facets > 0) continue;
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
    if (window.facets == 0) continue;
    facets += window.facets;
    const std::vector<double> taken = steps_in(manager, window.length);
    for (std::size_t k = 0; k < parts; ++k) {
      cost.facet[k] += window.seconds[k] - cost.step[k] * taken[k];
    }
  }
  for (double& seconds : cost.facet) seconds = facets > 0.0 ? std::max(0.0, seconds / facets) : 0.0;
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

}  // namespace

Forecast forecast(Simulation& simulation, std::span<const double> outputs, double trial_seconds,
                  double building_seconds, std::optional<double> facets_at_end) {
  CouplingManager& manager = *simulation.manager;
  const Clock::time_point begin = Clock::now();
  const double processors_before = processor_time();
  const std::vector<double> at_start = spent(manager, begin);
  std::vector<Trial> trial;
  Forecast result{};
  const Index facets_at_start = facet_count(simulation);
  const auto goes_on = [&] {
    if (trial.empty()) return true;  // nothing can be foretold from no window
    const Index gained = facet_count(simulation) - facets_at_start;
    const double to_come = facets_at_end.value_or(0.0) - facets_at_start;
    const bool waits =
        gained < std::min<double>(telling_facets, to_come) || manager.time() > far * outputs.back();
    return processor_time() - processors_before < (waits ? longest_wait : 1.0) * trial_seconds;
  };
  auto output = outputs.begin();
  Reach reach(manager);
  try {
    manager.settle();
    while (output != outputs.end() && goes_on()) {
      const double t = manager.time();
      const Index facets = facet_count(simulation);
      const std::vector<double> before = spent(manager, begin);
      const double used = processor_time();
      manager.advance(std::min(*output, reach.next(trial_seconds - (used - processors_before))));
      reach.took(processor_time() - used, manager.time() - t);
      trial.push_back({manager.time() - t, spent_since(before, spent(manager, begin)),
                       facet_count(simulation) - facets});
      if (manager.time() != *output) continue;
      manager.restart_point();  // as a run does
      ++output;
    }
  } catch (const NumericalError& error) {
    result.failure = error.what();
  }
  result.trial_time = manager.time();
  result.trial_seconds = since(begin);
  result.is_whole = output == outputs.end();
  result.windows = manager.step();

  std::vector<double> parts = spent_since(at_start, spent(manager, begin));
  if (!result.is_whole && !result.failure) {
    // What the first windows take is of their own: caches fill, iterations find their pace.
    const std::span all(trial);
    const Cost cost = cost_of(manager, all.subspan(all.size() / 2));
    for_each_window_to_come(manager, outputs, [&](double length) {
      const std::vector<double> steps = steps_in(manager, length);
      for (std::size_t k = 0; k < parts.size(); ++k) parts[k] += cost.step[k] * steps[k];
      ++result.windows;
    });
    const double facets = std::max(0.0, facets_at_end.value_or(0.0) - facet_count(simulation));
    // A facet costs half a window of its own, too: growth ends the one that it comes in, anywhere.
    for (std::size_t k = 0; k < parts.size(); ++k) {
      parts[k] += (0.5 * cost.step[k] + cost.facet[k]) * facets;
    }
    result.windows += std::llround(0.5 * facets);
  }
  // As if nothing else ran: one thread is then never kept waiting.
  const double used = processor_time() - processors_before;
  const double quiet = std::min(1.0, used / result.trial_seconds);
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
