#pragma once

#include <memory>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/solvers/multigrid.hpp"

namespace perifrac {

/// What is near to the inverse of S + gamma H, S a diagonal that is not negative and H a
/// diffusion's matrix (smoothed_aggregation.hpp), by one cycle over aggregates: symmetric, and as
/// near whatever the number of unknowns. S and gamma change at the cost of a product. Coarser
/// levels know the sums of S only.
class FlowMultigrid {
 public:
  /// `held`: by unknown; at 0.
  FlowMultigrid(Eigen::SparseMatrix<double> flow, std::vector<bool> held);
  ~FlowMultigrid();

  /// Before the first apply().
  void set(const Eigen::VectorXd& storage, double gamma);
  /// p = B r.
  void apply(const Eigen::VectorXd& r, Eigen::VectorXd& p) { multigrid_->precondition(r, p); }

 private:
  class Level;

  void set_levels(const Eigen::VectorXd& storage, double gamma);

  std::vector<Level*> levels_;  ///< multigrid_'s
  std::unique_ptr<Multigrid> multigrid_;
};

}  // namespace perifrac
