#include "modules/solid/equilibrium/newton_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/base/eigen_view.hpp"
#include "modules/solid/material/nonlinear_response.hpp"

namespace perifrac {

namespace {

// Of displacements; squared, as errors are energies.
constexpr double balance_tolerance = 1e-10, beside_rounding = 1e-8, linear_tolerance = 1e-4;
constexpr int most_rounds = 30, most_halvings = 10, most_iterations = 500;

constexpr const char* remedy =
    "shorten the windows, lower the load, or take type: dynamic with damping";

}  // namespace

template <int D>
NewtonSolver<D>::NewtonSolver(std::shared_ptr<ElasticOperator<D>> elastic,
                              std::unique_ptr<StiffnessSolver<D>> at_rest)
    : elastic_(std::move(elastic)), at_rest_(std::move(at_rest)) {}

template <int D>
void NewtonSolver<D>::prepare() {
  at_rest_->prepare();
  inner_.setZero(elastic_->size());
}

template <int D>
std::string NewtonSolver<D>::path() const {
  return "Newton's method; at rest " + at_rest_->path();
}

template <int D>
Eigen::VectorXd NewtonSolver<D>::at_rest(const Eigen::VectorXd& force) {
  const Eigen::VectorXd none = Eigen::VectorXd::Zero(force.size());
  Eigen::VectorXd answer = none;
  at_rest_->solve(force, none, answer);
  return answer;
}

template <int D>
void NewtonSolver<D>::find_left_over(const Eigen::VectorXd& load, const Eigen::VectorXd& unknowns) {
  elastic_->respond(view(unknowns), view(inner_));
  left_over_ = load - inner_;
  answer_ = at_rest(left_over_);
  error_ = left_over_.dot(answer_);
}

/// Of Newton: the stiffness that was taken last times it is `force`; `answer` is at_rest(force).
template <int D>
Eigen::VectorXd NewtonSolver<D>::step(const Eigen::VectorXd& force, const Eigen::VectorXd& answer) {
  Eigen::VectorXd sum = Eigen::VectorXd::Zero(force.size()), left = force, z = answer;
  Eigen::VectorXd direction = answer, product(force.size());
  double error = left.dot(z);
  const double target = linear_tolerance * linear_tolerance * error;
  for (int k = 0; error > target && k < most_iterations; ++k) {
    elastic_->nonlinear()->apply_tangent(view(std::as_const(direction)), view(product));
    const double stiffness = direction.dot(product);
    if (!(stiffness > 0.0)) {
      throw NoEquilibrium(fmt::format("the body does not resist any more; {}", remedy));
    }
    sum += error / stiffness * direction;
    left -= error / stiffness * product;
    z = at_rest(left);
    const double next = left.dot(z);
    direction = z + next / error * direction;
    error = next;
  }
  return sum;
}

template <int D>
void NewtonSolver<D>::solve(const Eigen::VectorXd& load, const Eigen::VectorXd&,
                            Eigen::VectorXd& unknowns) {
  find_left_over(load, unknowns);
  double scale = error_;
  for (int round = 0; round < most_rounds; ++round) {
    scale = std::max(scale, unknowns.cwiseProduct(inner_).cwiseAbs().sum());
    if (error_ <= balance_tolerance * balance_tolerance * scale) return;
    elastic_->nonlinear()->linearise(view(std::as_const(unknowns)));
    const Eigen::VectorXd before = unknowns, change = step(left_over_, answer_);
    const double error_before = error_;
    double part = 1.0;
    for (int k = 0; k <= most_halvings; ++k, part *= 0.5) {
      unknowns = before + part * change;
      find_left_over(load, unknowns);
      if (error_ < error_before) break;
    }
    if (!(error_ < error_before)) break;
  }
  if (error_ <= beside_rounding * beside_rounding * scale) return;
  throw NoEquilibrium(fmt::format("Newton's method leaves {:.2g} of the force; {}",
                                  std::sqrt(error_ / scale), remedy));
}

template class NewtonSolver<2>;
template class NewtonSolver<3>;

}  // namespace perifrac
