#include "app/references/solutions/terzaghi_solution.hpp"

#include "app/references/solutions/slab_drainage.hpp"

namespace perifrac {

TerzaghiSolution::TerzaghiSolution(const TerzaghiProblem& problem) : problem_(problem) {
  const double alpha = problem.biot_coefficient;
  const double stiffness = problem.uniaxial_modulus;
  consolidation_ = problem.mobility / (problem.storage + alpha * alpha / stiffness);
  initial_pressure_ = alpha * problem.load / (problem.storage * stiffness + alpha * alpha);
}

double TerzaghiSolution::time_scale() const {
  return problem_.height * problem_.height / consolidation_;
}

double TerzaghiSolution::drained_strain() const {
  return -problem_.load / problem_.uniaxial_modulus;
}

double TerzaghiSolution::final_settlement() const { return -drained_strain() * problem_.height; }

double TerzaghiSolution::pressure(double z, double t) const {
  return initial_pressure_ * slab_drainage::value(z / problem_.height, t / time_scale());
}

double TerzaghiSolution::displacement(double z, double t) const {
  const double height = problem_.height;
  const double pressures =
      initial_pressure_ * height * slab_drainage::integral(z / height, t / time_scale());
  return (problem_.biot_coefficient * pressures - problem_.load * z) / problem_.uniaxial_modulus;
}

}  // namespace perifrac
