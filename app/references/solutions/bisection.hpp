#pragma once

namespace perifrac {

/// The root of `f` between `low` and `high`, where it has opposite signs, to the last bit.
template <class Function>
double bisect(Function f, double low, double high) {
  const bool low_positive = f(low) > 0.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) return middle;
    ((f(middle) > 0.0) == low_positive ? low : high) = middle;
  }
}

}  // namespace perifrac
