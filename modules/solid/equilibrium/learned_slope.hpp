#pragma once

#include <Eigen/Core>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// How facets of cracks open by pressure in them, where solves show it one pressure after another:
/// it begins as that of a body without end and learns from each solve.
class LearnedSlope {
 public:
  void clear();
  Eigen::Index size() const { return root_area_.size(); }
  /// Symmetric times the areas [m/Pa].
  Eigen::MatrixXd matrix() const;
  bool is_finite() const { return slope_.allFinite(); }

  /// Takes in the facets that have come. `stiffness`: pressures by openings of all facets, of a
  /// body without end (pressure_by_opening) [Pa/m]; what is known of the others is kept. `area`: of
  /// all.
  void extend(const Eigen::MatrixXd& stiffness, const Eigen::VectorXd& area);
  /// Facets but the first `count` are closed again.
  void keep(Eigen::Index count);
  /// A change of pressure [Pa] opened facets so far [m]: the change of least rank that says so, and
  /// leaves the slope symmetric and positive definite (BFGS).
  void learn(const Eigen::VectorXd& pressure, const Eigen::VectorXd& opening);

  void visit_state(StateVisitor& visitor);

 private:
  void add(const Eigen::VectorXd& stiffness);

  Eigen::VectorXd root_area_;
  Eigen::MatrixXd slope_;  ///< of pressures and openings times the root of a facet's area
};

}  // namespace perifrac
