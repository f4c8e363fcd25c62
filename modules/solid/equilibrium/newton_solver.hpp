#pragma once

#include <memory>
#include <stdexcept>

#include "modules/solid/equilibrium/stiffness_solver.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// Newton's method finds no equilibrium.
class NoEquilibrium : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The equilibrium of a body whose stiffness changes with its strain: Newton's method with a line
/// search. Each of its linear equations is solved by conjugate gradients, for which the stiffness
/// at rest, solved for by `at_rest`, is the preconditioner: nothing is factored anew. Errors are
/// measured by the energy that the force left over has in the body at rest.
template <int D>
class NewtonSolver final : public StiffnessSolver<D> {
 public:
  NewtonSolver(std::shared_ptr<ElasticOperator<D>> elastic,
               std::unique_ptr<StiffnessSolver<D>> at_rest);

  void prepare() override;
  std::string path() const override;
  bool goes_on() const override { return true; }
  /// Throws also NoEquilibrium.
  void solve(const Eigen::VectorXd& load, const Eigen::VectorXd& inner,
             Eigen::VectorXd& unknowns) override;

 private:
  /// What a body at rest answers to a force [m].
  Eigen::VectorXd at_rest(const Eigen::VectorXd& force);
  Eigen::VectorXd step(const Eigen::VectorXd& force, const Eigen::VectorXd& answer);
  void find_left_over(const Eigen::VectorXd& load, const Eigen::VectorXd& unknowns);

  std::shared_ptr<ElasticOperator<D>> elastic_;
  std::unique_ptr<StiffnessSolver<D>> at_rest_;
  Eigen::VectorXd inner_, left_over_, answer_;  ///< at the displacements last looked at
  double error_ = 0.0;                          ///< [J]
};

}  // namespace perifrac
