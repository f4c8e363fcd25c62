#include "app/references/solutions/poiseuille_solution.hpp"

#include <cmath>
#include <numbers>

namespace perifrac {

double PoiseuilleSolution::velocity(double y, double t) const {
  if (t <= 0.0) return 0.0;
  const double eta = y / problem_.gap;
  const double T = t / time_scale();
  double sum = 0.5 * eta * (1.0 - eta);
  // Terms fall as n^-3 at once and by the exponential later: 1e-11 of the peak is left out.
  for (int n = 1; n < 10000; n += 2) {
    const double m = n * std::numbers::pi;
    if (m * m * T > 40.0) break;
    sum -= 4.0 / (m * m * m) * std::sin(m * eta) * std::exp(-m * m * T);
  }
  return problem_.acceleration * time_scale() * sum;
}

}  // namespace perifrac
