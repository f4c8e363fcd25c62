#include "app/references/solutions/cryer_solution.hpp"

#include <cmath>
#include <numbers>

#include "app/references/solutions/bisection.hpp"
#include "app/references/solutions/place_of_largest.hpp"

namespace perifrac {

namespace {

// Enough for c t / a^2 >= 1e-6.
constexpr int modes = 2000;

double sinc(double x) { return x == 0.0 ? 1.0 : std::sin(x) / x; }

}  // namespace

CryerSolution::CryerSolution(const CryerProblem& problem) : problem_(problem) {
  const double alpha = problem.biot_coefficient;
  const double bulk = problem.bulk_modulus;
  const double uniaxial = bulk + 4.0 / 3.0 * problem.shear_modulus;
  const double capacity = problem.storage + alpha * alpha / uniaxial;
  const double beta =
      4.0 * problem.shear_modulus * alpha * alpha / (3.0 * bulk * uniaxial * capacity);
  consolidation_ = problem.mobility / capacity;
  initial_pressure_ = alpha * problem.load / (alpha * alpha + problem.storage * bulk);
  const auto condition = [beta](double x) {
    return (1.0 + beta) * x * x * std::sin(x) - 3.0 * beta * (std::sin(x) - x * std::cos(x));
  };
  for (int n = 0; n < modes; ++n) {
    // At 0 the condition is 0 as well, and positive beyond.
    const double low = n == 0 ? 1e-3 : n * std::numbers::pi;
    const double x = bisect(condition, low, (n + 1) * std::numbers::pi);
    const double surface = sinc(x);
    const double mean_of_sinc = 3.0 * (std::sin(x) - x * std::cos(x)) / (x * x * x);
    const double mean = mean_of_sinc - surface;
    const double mean_square =
        1.5 / (x * x) * (1.0 - sinc(2.0 * x)) - 2.0 * surface * mean_of_sinc + surface * surface;
    // p0 projected on the mode: both sides of d/dt (p + beta mean(p)) are symmetric.
    modes_.push_back({x, (1.0 + beta) * mean / (mean_square + beta * mean * mean), mean});
  }
}

double CryerSolution::time_scale() const {
  return problem_.radius * problem_.radius / consolidation_;
}

double CryerSolution::pressure(double r, double t) const {
  if (t <= 0.0) return initial_pressure_;
  double sum = 0.0;
  for (const Mode& mode : modes_) {
    const double decay = std::exp(-mode.x * mode.x * t / time_scale());
    if (decay == 0.0) break;
    sum += mode.amplitude * decay * (sinc(mode.x * r / problem_.radius) - sinc(mode.x));
  }
  return initial_pressure_ * sum;
}

double CryerSolution::mean_pressure(double t) const {
  if (t <= 0.0) return initial_pressure_;
  double sum = 0.0;
  for (const Mode& mode : modes_) {
    const double decay = std::exp(-mode.x * mode.x * t / time_scale());
    if (decay == 0.0) break;
    sum += mode.amplitude * decay * mode.mean;
  }
  return initial_pressure_ * sum;
}

double CryerSolution::surface_displacement(double t) const {
  return (problem_.biot_coefficient * mean_pressure(t) - problem_.load) /
         (3.0 * problem_.bulk_modulus) * problem_.radius;
}

CryerSolution::Peak CryerSolution::peak() const {
  const auto at = [&](double log_time) { return pressure(0.0, time_scale() * std::exp(log_time)); };
  const double best = place_of_largest(at, std::log(1e-4), std::log(1.0));
  return {at(best), time_scale() * std::exp(best)};
}

}  // namespace perifrac
