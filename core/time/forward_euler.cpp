#include "core/time/forward_euler.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/errors.hpp"
#include "core/state/compensated_sum.hpp"
#include "core/time/equal_steps.hpp"

namespace perifrac {

ForwardEuler::ForwardEuler(OdeSystem& system, double safety) : system_(system), safety_(safety) {}

void ForwardEuler::reset(double t, std::span<const double>) {
  t_ = t;
  if (limit_version_ != system_.jacobian_version()) {
    stable_step_ = 2.0 / system_.fastest_rate(t);  // infinity where nothing flows
    limit_version_ = system_.jacobian_version();
  }
  rate_.resize(system_.size());
  lost_.assign(system_.accumulators(), 0.0);
}

/// The longest step that may begin at t.
double ForwardEuler::limit_at(double t, double growth) const {
  const double longest = safety_ * stable_step_ / growth;
  return std::clamp(0.5 * (t - jump_), 0.125 * longest, longest);
}

/// Of steps beyond half of the stable limit, which turn the sign of the fastest modes, an even
/// number where that matters.
std::int64_t ForwardEuler::steps_over(double length, double limit) const {
  const std::int64_t steps = equal_steps(length, limit);
  const bool turns = steps % 2 == 1 && length > 0.5 * static_cast<double>(steps) * stable_step_;
  return turns && system_.is_answered_late() ? steps + 1 : steps;
}

void ForwardEuler::advance(double t_end, std::span<double> y) {
  if (t_end == t_) return;
  double begin = t_, step = 0.0, limit = 0.0;  // equal steps from `begin` while it is the same
  std::int64_t steps = 0;
  for (std::int64_t n = 0; n == 0 || n < steps; ++n, ++statistics_.steps) {
    const double t = begin + static_cast<double>(n) * step;
    if (const double now = limit_at(t, system_.jacobian_growth(t, y)); now != limit) {
      begin = t;
      n = 0;
      limit = now;
      steps = steps_over(t_end - begin, limit);
      step = (t_end - begin) / static_cast<double>(steps);
    }
    system_.rhs(t + step, y, rate_);
    const std::size_t plain = y.size() - lost_.size();
    for (std::size_t i = 0; i < plain; ++i) y[i] += step * rate_[i];
    for (std::size_t k = 0; k < lost_.size(); ++k) {
      add_compensated(y[plain + k], lost_[k], step * rate_[plain + k]);
    }
  }
  t_ = t_end;
  statistics_.rhs_evaluations = statistics_.steps;
  const auto bad = std::find_if_not(y.begin(), y.end(), [](double v) { return std::isfinite(v); });
  if (bad != y.end())
    throw NumericalError(std::string(system_.name()), system_.place(bad - y.begin()), t_end,
                         "a value is not finite");
}

}  // namespace perifrac
