#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/SparseCore>

#include "core/body/body.hpp"
#include "core/solvers/multigrid.hpp"
#include "modules/solid/boundary/solid_boundary.hpp"
#include "modules/solid/equilibrium/stiffness_level.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// The equilibrium of an intact body on a lattice by multigrid: no matrix, no factor but that of
/// some hundred points. Coarse levels are bodies of their own with points twice as far apart
/// (coarse_body.hpp), the linear-exact operator on them, the same conditions at the faces, and
/// moduli that are the means of what a point stands for.
template <int D>
class StiffnessMultigrid {
 public:
  /// `free_unknowns` as of SolidBoundary.
  StiffnessMultigrid(const Body<D>& body, std::shared_ptr<ElasticOperator<D>> elastic,
                     const SolidBoundary<D>& boundary,
                     const Eigen::SparseMatrix<double>& free_unknowns);

  /// Why a body cannot be solved so, in words; empty where it can.
  static std::string obstacle(const Body<D>& body,
                              const Eigen::SparseMatrix<double>& free_unknowns);

  /// Adds to u what takes the force that is left over on the free unknowns, `residual` of all, to
  /// `tolerance` [N]. Returns the iterations that took. Throws NotConverged.
  int correct(Eigen::VectorXd& residual, Eigen::VectorXd& u, double tolerance);

  int level_count() const { return multigrid_->level_count(); }

  /// Sets what is held to 0.
  void hold(Eigen::VectorXd& u) const { finest_->hold(u); }

 private:
  const StiffnessLevel<D>* finest_ = nullptr;
  std::optional<Multigrid> multigrid_;
};

}  // namespace perifrac
