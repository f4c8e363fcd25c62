#pragma once

#include <cmath>
#include <numbers>

namespace perifrac {

/// The kernel of Wendland (1995), C2, whose integral over D dimensions is 1 [1/m^D]; `r` up to
/// `horizon` [m].
template <int D>
double wendland_kernel(double r, double horizon) {
  constexpr double scale =
      D == 2 ? 7.0 / std::numbers::pi : 10.5 / std::numbers::pi;  // over horizon^D
  const double q = r / horizon;
  return scale * std::pow(1.0 - q, 4) * (1.0 + 4.0 * q) / std::pow(horizon, D);
}

}  // namespace perifrac
