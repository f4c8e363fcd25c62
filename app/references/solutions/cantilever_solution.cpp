#include "app/references/solutions/cantilever_solution.hpp"

#include <cmath>
#include <numbers>

#include "app/references/solutions/beam_section.hpp"
#include "app/references/solutions/bisection.hpp"

namespace perifrac {

namespace {

/// Zero at natural frequencies. All squared: `b` is the frequency over that of L^4 rho A / (E I),
/// `r` the radius of gyration over L, `s` what shear adds, E I / (k A G L^2).
double frequency_condition(double b, double r, double s) {
  const double root = std::sqrt((r - s) * (r - s) + 4.0 / b);
  const double alpha = std::sqrt(0.5 * b * (root - r - s));
  const double beta = std::sqrt(0.5 * b * (root + r + s));
  return 2.0 + (b * (r - s) * (r - s) + 2.0) * std::cosh(alpha) * std::cos(beta) -
         std::sqrt(b) * (r + s) / std::sqrt(1.0 - b * r * s) * std::sinh(alpha) * std::sin(beta);
}

}  // namespace

CantileverSolution::CantileverSolution(const CantileverProblem& problem) {
  const BeamSection section(problem.youngs_modulus, problem.poisson_ratio, problem.height);
  const double length = problem.length;
  const double area = problem.height;  // per metre of thickness
  const double r = std::pow(problem.height / length, 2) / 12.0;
  const double s = section.bending / (section.shear * length * length);
  // Without shear and rotation the first b is 1.8751^4 = 12.3624; both only lower it.
  const double b =
      bisect([=](double value) { return frequency_condition(value, r, s); }, 1e-6, 12.4);
  angular_frequency_ =
      std::sqrt(b * section.bending / (problem.density * area)) / (length * length);
  const double load = problem.load * area;
  static_deflection_ = load * std::pow(length, 4) / (8.0 * section.bending) +
                       load * length * length / (2.0 * section.shear);
}

double CantileverSolution::period() const { return 2.0 * std::numbers::pi / angular_frequency_; }

double CantileverSolution::deflection(double t) const {
  return static_deflection_ * (1.0 - std::cos(angular_frequency_ * t));
}

}  // namespace perifrac
