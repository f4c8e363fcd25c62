#pragma once

#include <cmath>

namespace perifrac {

/// Where `f` is largest between `low` and `high`: the best of 200 steps, then golden section.
template <class Function>
double place_of_largest(Function f, double low, double high) {
  const double step = (high - low) / 200.0;
  double best = low;
  double largest = f(low);
  for (int n = 1; n <= 200; ++n) {
    const double value = f(low + n * step);
    if (value <= largest) continue;
    largest = value;
    best = low + n * step;
  }
  low = best - step;
  high = best + step;
  const double golden = 0.5 * (3.0 - std::sqrt(5.0));
  while (high - low > 1e-7) {
    const double left = low + golden * (high - low);
    const double right = high - golden * (high - low);
    (f(left) > f(right) ? high : low) = f(left) > f(right) ? right : left;
  }
  return 0.5 * (low + high);
}

}  // namespace perifrac
