#include "app/references/solutions/mandel_solution.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "app/references/solutions/bisection.hpp"
#include "app/references/solutions/place_of_largest.hpp"

namespace perifrac {

namespace {

// Terms of the series: enough for c t / a^2 >= 1e-6 to all digits that a comparison can see.
constexpr int terms = 2000;

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
  const auto condition = [ratio](double b) { return std::sin(b) - ratio * b * std::cos(b); };
  for (int n = 0; n < terms; ++n) {
    const double low = n * std::numbers::pi;
    root_.push_back(bisect(condition, low, low + 0.5 * std::numbers::pi));
  }
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
  const double second = problem_.half_width * problem_.half_width / consolidation_;
  const auto at = [&](double log_time) { return pressure(x, second * std::exp(log_time)); };
  return std::max(initial_pressure_, at(place_of_largest(at, std::log(1e-5), 0.0)));
}

}  // namespace perifrac
