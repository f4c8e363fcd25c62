#include "core/time/forward_euler.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

#include "core/errors.hpp"

namespace perifrac {
namespace {

double norm(std::span<const double> v) {
  double sum = 0.0;
  for (const double value : v) sum += value * value;
  return std::sqrt(sum);
}

/// Upper bound of the largest |eigenvalue| of the J of reference [1/s] by power iteration. The top
/// of a lattice operator's spectrum is crowded: the vector hardly converges, but the growth per
/// iteration does, from below, so the bound adds a margin over the tolerance and what slow
/// convergence hides.
double spectral_radius(OdeSystem& system, double t) {
  constexpr int max_iterations = 500;
  constexpr int settled_iterations = 10;
  constexpr double tolerance = 1e-3;
  constexpr double margin = 1.02;
  const std::size_t coupled = system.size() - system.accumulators();
  std::vector<double> v(system.size(), 0.0), product(system.size());
  // A fixed sequence without structure: it must hold a part of the fastest mode, whichever it is.
  std::uint32_t bits = 1;
  for (std::size_t i = 0; i < coupled; ++i) {
    bits = bits * 1664525u + 1013904223u;
    v[i] = static_cast<double>(bits >> 8) / (1u << 23) - 1.0;
  }
  double length = norm(v);
  double checked = 0.0;
  for (int iteration = 1; iteration <= max_iterations; ++iteration) {
    for (double& value : v) value /= length;
    system.jacobian_times(t, {}, v, product);
    const double radius = norm(std::span(product).first(coupled));
    if (radius == 0.0) return 0.0;
    if (!std::isfinite(radius)) break;
    if (iteration % settled_iterations == 0) {
      if (std::abs(radius - checked) <= tolerance * radius) return margin * radius;
      checked = radius;
    }
    std::copy_n(product.begin(), coupled, v.begin());
    length = radius;
  }
  throw NumericalError(std::string(system.name()), "the explicit integrator", t,
                       "the stable time step could not be found");
}

}  // namespace

ForwardEuler::ForwardEuler(OdeSystem& system, double safety) : system_(system), safety_(safety) {}

void ForwardEuler::reset(double t, std::span<const double>) {
  t_ = t;
  if (limit_version_ != system_.jacobian_version()) {
    stable_step_ = 2.0 / spectral_radius(system_, t);  // infinity where nothing flows
    limit_version_ = system_.jacobian_version();
  }
  rate_.resize(system_.size());
}

void ForwardEuler::advance(double t_end, std::span<double> y) {
  if (t_end == t_) return;
  double begin = t_, step = 0.0, growth = 0.0;  // equal steps from `begin` while J is the same
  std::int64_t steps = 0;
  for (std::int64_t n = 0; n == 0 || n < steps; ++n, ++statistics_.steps) {
    const double t = begin + static_cast<double>(n) * step;
    if (const double now = system_.jacobian_growth(t, y); now != growth) {
      begin = t;
      n = 0;
      growth = now;
      const double limit = safety_ * stable_step_ / growth;
      steps =
          std::max<std::int64_t>(1, static_cast<std::int64_t>(std::ceil((t_end - begin) / limit)));
      step = (t_end - begin) / static_cast<double>(steps);
    }
    system_.rhs(t, y, rate_);
    for (std::size_t i = 0; i < y.size(); ++i) y[i] += step * rate_[i];
  }
  t_ = t_end;
  statistics_.rhs_evaluations = statistics_.steps;
  const auto bad = std::find_if_not(y.begin(), y.end(), [](double v) { return std::isfinite(v); });
  if (bad != y.end())
    throw NumericalError(std::string(system_.name()), system_.place(bad - y.begin()), t_end,
                         "a value is not finite");
}

}  // namespace perifrac
