#pragma once

#include <string>

#include "app/references/reference.hpp"

namespace perifrac {

/// What a quantity does between two rows of a history: it goes evenly from one to the next, or
/// stays as it was until the later one, as the size of a crack does.
enum class BetweenRows { linear, held };

/// What a figure makes of a history where a crack grows facet by facet, with which everything goes
/// up and down: means of computed over exact within one step of growth, each of which lies in the
/// latter half of the run; of these the one farthest from 1, none where no step fits. `step` is the
/// time [s] that growth by one spacing takes about t, NaN where there is none yet.
decltype(Reference::Figure::computed) worst_mean_of_growth(Reference::OfTime step, double end,
                                                           Reference::OfTime exact,
                                                           BetweenRows between);

/// What is compared of a growing crack.
struct OfGrowth {
  std::string quantity, place, unit;
  BetweenRows between = BetweenRows::linear;
  Reference::Computed computed;
  Reference::OfTime exact;
};

/// Adds its relative error, its history and the figure above, named after `quantity`.
void compare_growth(Reference& reference, const OfGrowth& compared, const Reference::OfTime& step,
                    double end);

}  // namespace perifrac
