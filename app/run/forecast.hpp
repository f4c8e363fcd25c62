#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "app/simulation/simulation.hpp"

namespace perifrac {

/// What a run would take, from a trial of its first windows on this machine.
struct Forecast {
  double trial_time;                   ///< how far the trial came [s of the scene]
  double trial_seconds;                ///< what it took
  bool is_whole;                       ///< the trial came to the end: nothing is extrapolated
  std::optional<std::string> failure;  ///< where the trial stopped: the run will, too
  std::int64_t windows;                ///< of the whole run
  double seconds;                      ///< likewise, writing results apart
  /// Of `seconds`: every module, what couples them, and what it takes to build them.
  std::vector<std::pair<std::string, double>> seconds_by_part;
  long memory;  ///< the most that the trial held [bytes]
};

/// Runs what was initialised for about `trial_seconds` and extrapolates to the last of `outputs`
/// [s]: a window costs a module what it did on average or, where the module has a stable step of
/// its own, what a step did; a facet that cracks gain costs what it did and half a window more.
/// Where it is not known how far they will grow, windows in which they grow count as any others.
/// `facets_at_end`: how many there will be in the end, where it is known. `building_seconds`: what
/// is spent already. Times are those of a machine where nothing else runs, if one thread does.
/// Leaves the simulation where the trial ended.
Forecast forecast(Simulation& simulation, std::span<const double> outputs, double trial_seconds,
                  double building_seconds, std::optional<double> facets_at_end);

}  // namespace perifrac
