#include "app/references/solutions/seepage_solution.hpp"

#include <algorithm>

#include "app/references/solutions/slab_inflow.hpp"

namespace perifrac {

double SeepageSolution::time_scale() const {
  return problem_.length * problem_.length * problem_.storage / problem_.mobility;
}

double SeepageSolution::steady_flux() const {
  return problem_.mobility * problem_.pressure / problem_.length;
}

double SeepageSolution::water_pressure(double t) const {
  return problem_.pressure * problem_.schedule.factor(t);
}

/// To what the water's pressure does beside the initial one, from the answers to 1 Pa and 1 Pa/s.
template <class Step, class Ramp>
double SeepageSolution::answer(Step step, Ramp ramp, double t) const {
  double sum = (water_pressure(0.0) - problem_.initial_pressure) * step(t);
  double from = 0.0;
  for (const double to : problem_.schedule.break_points()) {
    if (to <= from) continue;
    const double rate = (water_pressure(to) - water_pressure(from)) / (to - from);
    sum += rate * (ramp(t - from) - ramp(t - to));
    from = to;
  }
  return sum;
}

double SeepageSolution::pressure(double z, double t) const {
  const double xi = z / problem_.length;
  const double scale = time_scale();
  return problem_.initial_pressure * xi +
         answer([=](double s) { return slab_inflow::value(xi, s / scale); },
                [=](double s) { return scale * slab_inflow::value_integral(xi, s / scale); }, t);
}

double SeepageSolution::volume(double t) const {
  const double scale = time_scale();
  const double capacity = problem_.storage * problem_.length;
  return problem_.initial_pressure * problem_.mobility / problem_.length * t +
         capacity *
             answer([=](double s) { return slab_inflow::inflow(s / scale); },
                    [=](double s) { return scale * slab_inflow::inflow_integral(s / scale); }, t);
}

}  // namespace perifrac
