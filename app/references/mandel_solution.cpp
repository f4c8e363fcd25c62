#include "app/references/mandel_solution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace perifrac {

namespace {

// Terms of the series: enough for c t / a^2 >= 1e-6 to all digits that a comparison can see.
constexpr int terms = 2000;

/// The n-th positive root of tan(b) = ratio b, between n pi and (n + 1/2) pi, by bisection.
double characteristic_root(int n, double ratio) {
  double low = n * std::numbers::pi;
  double high = low + 0.5 * std::numbers::pi;
  for (int halving = 0; halving < 200 && high - low > 0.0; ++halving) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    const bool above = std::sin(middle) - ratio * middle * std::cos(middle) > 0.0;
    // sin - ratio b cos has the sign of tan - ratio b where cos > 0, as (-1)^n.
    ((n % 2 == 0) == above ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace

MandelSolution::MandelSolution(const MandelProblem& problem) : problem_(problem) {
  const double lambda = problem.lame_lambda;
  const double mu = problem.shear_modulus;
  const double alpha = problem.biot_coefficient;
  const double biot_modulus = 1.0 / problem.storage;
  poisson_ratio_ = lambda / (2.0 * (lambda + mu));
  const double undrained_bulk = lambda + 2.0 / 3.0 * mu + alpha * alpha * biot_modulus;
  skempton_ = alpha * biot_modulus / undrained_bulk;
  const double ab = alpha * skempton_ * (1.0 - 2.0 * poisson_ratio_);
  undrained_poisson_ratio_ = (3.0 * poisson_ratio_ + ab) / (3.0 - ab);
  consolidation_ = problem.mobility / (problem.storage + alpha * alpha / (lambda + 2.0 * mu));
  initial_pressure_ =
      skempton_ * (1.0 + undrained_poisson_ratio_) * problem.force / (3.0 * problem.half_width);
  const double ratio = (1.0 - poisson_ratio_) / (undrained_poisson_ratio_ - poisson_ratio_);
  for (int n = 0; n < terms; ++n) root_.push_back(characteristic_root(n, ratio));
}

double MandelSolution::dimensionless_time(double t) const {
  return consolidation_ * t / (problem_.half_width * problem_.half_width);
}

double MandelSolution::pressure(double x, double t) const {
  if (t <= 0.0) return initial_pressure_;
  const double time = dimensionless_time(t);
  double sum = 0.0;
  for (const double b : root_) {
    const double decay = std::exp(-b * b * time);
    if (decay == 0.0) break;
    sum += std::sin(b) / (b - std::sin(b) * std::cos(b)) *
           (std::cos(b * x / problem_.half_width) - std::cos(b)) * decay;
  }
  return 2.0 * initial_pressure_ * sum;
}

double MandelSolution::plate_displacement(double t) const {
  const double scale =
      problem_.force * problem_.half_height / (problem_.shear_modulus * problem_.half_width);
  if (t <= 0.0) return -0.5 * scale * (1.0 - undrained_poisson_ratio_);
  const double time = dimensionless_time(t);
  double sum = 0.0;
  for (const double b : root_) {
    const double decay = std::exp(-b * b * time);
    if (decay == 0.0) break;
    sum += std::sin(b) * std::cos(b) / (b - std::sin(b) * std::cos(b)) * decay;
  }
  return scale * (-0.5 * (1.0 - poisson_ratio_) + (1.0 - undrained_poisson_ratio_) * sum);
}

double MandelSolution::peak_pressure(double x) const {
  // Over dimensionless times 1e-5 .. 1 in logarithmic steps, then golden section about the best.
  const double second = problem_.half_width * problem_.half_width / consolidation_;
  const auto at = [&](double log_time) { return pressure(x, second * std::exp(log_time)); };
  double best = std::log(1e-5);
  constexpr double step = 0.05;
  for (double s = best; s <= 0.0; s += step) {
    if (at(s) > at(best)) best = s;
  }
  double low = best - step;
  double high = best + step;
  const double golden = 0.5 * (3.0 - std::sqrt(5.0));
  while (high - low > 1e-7) {
    const double left = low + golden * (high - low);
    const double right = high - golden * (high - low);
    (at(left) > at(right) ? high : low) = at(left) > at(right) ? right : left;
  }
  return std::max(initial_pressure_, at(0.5 * (low + high)));
}

}  // namespace perifrac
