#pragma once

#include <cmath>

namespace perifrac {

/// Where a tip is within its facet at the end of a window, in parts of the facet: looked for from
/// pass to pass of the window, by a secant on what drives it over what holds it.
class TipSearch {
 public:
  /// It is looked for up to so far.
  static constexpr double farthest = 1.25;

  /// A window in which it goes on from `part` is about to be tried, first at `guess`.
  void begin(double part, double guess);
  /// It is here, and nothing is looked for.
  void put(double part) { trial_ = part; }

  double trial() const { return trial_; }
  /// Where the last two trials say that it would be, however far.
  double reach() const { return reach_; }

  /// `excess`: the logarithm of what drives over what holds it there; `foretold`: of where it is,
  /// of which little is known. True where another place has to be tried.
  bool look_further(double excess, double foretold);

 private:
  double part_ = 0.0, trial_ = 0.0, reach_ = 0.0;
  double trial_before_ = NAN, excess_before_ = NAN;
  double low_ = 0.0, high_ = farthest;  ///< it is between
  int tries_ = 0;
};

}  // namespace perifrac
