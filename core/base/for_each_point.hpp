#pragma once

#include "core/base/points.hpp"
#include "core/base/ranks.hpp"

namespace perifrac {

/// Below this many points, waking a thread costs more than its share of a loop.
inline constexpr Index points_worth_threads = 8000;

/// Calls use(i) for every point, in parallel; use(i) may write what belongs to point i only, so
/// that the result does not depend on the number of threads.
template <class Use>
void for_each_point(Index count, Use&& use) {
#pragma omp parallel for schedule(static) if (count >= points_worth_threads)
  for (Index i = 0; i < count; ++i) use(i);
}

/// The same divided among processes: what use(i) writes must be gathered, by
/// ranks::gather_shares(), before it is read.
template <class Use>
void for_each_shared_point(Index count, Use&& use) {
  const ranks::Share own = ranks::share(count, count);
#pragma omp parallel for schedule(static) if (own.end - own.begin >= points_worth_threads)
  for (Index i = own.begin; i < own.end; ++i) use(i);
}

}  // namespace perifrac
