#pragma once

#include <algorithm>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// Below this many entries of a vector, waking a thread costs more than its share of a pass over
/// it.
inline constexpr Index entries_worth_threads = 32000;

/// for_each_point() for loops that do next to nothing an entry.
template <class Use>
void for_each_entry(Index count, Use&& use) {
#pragma omp parallel for schedule(static) if (count >= entries_worth_threads)
  for (Index i = 0; i < count; ++i) use(i);
}

/// The sum of term(i) over 0 <= i < count, in parallel, with the same bits at any thread count:
/// blocks of a fixed size, their sums in their order. `term` may write what belongs to i only.
template <class Term>
double block_sum(Index count, std::vector<double>& workspace, Term&& term) {
  constexpr Index size = 2048;
  const Index blocks = (count + size - 1) / size;
  workspace.resize(blocks);
#pragma omp parallel for schedule(static) if (count >= entries_worth_threads)
  for (Index b = 0; b < blocks; ++b) {
    double sum = 0.0;
    for (Index i = b * size; i < std::min(count, (b + 1) * size); ++i) sum += term(i);
    workspace[b] = sum;
  }
  double total = 0.0;
  for (const double sum : workspace) total += sum;
  return total;
}

}  // namespace perifrac
