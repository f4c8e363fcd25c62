#include "modules/solid/equilibrium/tip_search.hpp"

#include <algorithm>

namespace perifrac {

namespace {

/// A tip is where the excess is below this.
constexpr double excess_tolerance = 5e-4;
/// Between places so close, of which one is too far and one not, either will do.
constexpr double narrow = 1e-3;
constexpr int most_tries = 15;

}  // namespace

void TipSearch::begin(double part, double guess) {
  part_ = low_ = part;
  trial_ = reach_ = guess;
  high_ = farthest;
  trial_before_ = excess_before_ = NAN;
  tries_ = 0;
}

bool TipSearch::look_further(double excess, double foretold) {
  // The first pass is of the openings that were foretold, not of the cut that is held now.
  if (++tries_ == 1) return true;
  const double slope = (excess - excess_before_) / (trial_ - trial_before_);
  reach_ = std::isfinite(slope) && slope < 0.0 ? trial_ - excess / slope : foretold;
  const bool stands = trial_ <= part_ && excess <= excess_tolerance;
  const bool beyond = trial_ >= farthest && excess >= -excess_tolerance;
  if (std::abs(excess) <= excess_tolerance || stands || beyond) return false;
  (excess > 0.0 ? low_ : high_) = trial_;
  if (!(low_ < high_)) {  // other modules have gone on meanwhile
    if (excess > 0.0) high_ = farthest;
    if (excess < 0.0) low_ = part_;
  }
  if ((tries_ > 2 && high_ - low_ < narrow) || tries_ > most_tries) return false;
  excess_before_ = excess;
  trial_before_ = trial_;
  const double next = std::clamp(reach_, low_, high_), margin = 0.02 * (high_ - low_);
  // The ends have been tried, but for where it stood and as far as it may go.
  const bool at_low = next <= low_ + margin && (low_ > part_ || excess > 0.0);
  const bool at_high = next >= high_ - margin && (high_ < farthest || excess < 0.0);
  trial_ = at_low || at_high ? 0.5 * (low_ + high_) : next;
  return true;
}

}  // namespace perifrac
