#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "core/operators/coarse_interpolation.hpp"
#include "core/solvers/multigrid.hpp"
#include "modules/solid/material/elastic_operator.hpp"

namespace perifrac {

/// The stiffness of a body on one level of a Multigrid: never formed, applied bond by bond. Some
/// unknowns are held at 0.
template <int D>
class StiffnessLevel final : public MultigridLevel {
 public:
  /// `held`: by unknown; `inverse_diagonal`: 0 for those.
  StiffnessLevel(std::shared_ptr<ElasticOperator<D>> elastic, std::vector<bool> held,
                 Eigen::VectorXd inverse_diagonal);

  /// The way to the next coarser level, where there is one.
  void set_way(CoarseInterpolation<D> way) {
    way_ = std::make_unique<CoarseInterpolation<D>>(std::move(way));
  }

  Eigen::Index size() const override { return inverse_diagonal_.size(); }
  void apply(const Eigen::VectorXd& u, Eigen::VectorXd& result) override;
  const Eigen::VectorXd& inverse_diagonal() const override { return inverse_diagonal_; }
  void restrict_residual(const Eigen::VectorXd& residual, Eigen::VectorXd& coarse) const override;
  void add_correction(const Eigen::VectorXd& coarse, Eigen::VectorXd& u) const override;

  /// Sets what is held to 0.
  void hold(Eigen::VectorXd& u) const;
  /// As a matrix, with rows and columns of the unit matrix for what is held.
  Eigen::SparseMatrix<double> assemble() const;
  /// A crack opens on the way to the next coarser level (CoarseInterpolation::cut).
  void cut_way(const CrackFacet<D>& facet, const Points<D>& fine, const Family<D>& coarse,
               double reach) {
    way_->cut(facet, fine, coarse, reach);
  }
  /// The coarser level's, once it is there: what it holds goes to 0 in its residuals.
  void set_coarser(const StiffnessLevel& coarser) { coarser_ = &coarser; }

 private:
  std::shared_ptr<ElasticOperator<D>> elastic_;
  std::vector<Index> held_;
  Eigen::VectorXd inverse_diagonal_;
  std::unique_ptr<CoarseInterpolation<D>> way_;
  const StiffnessLevel* coarser_ = nullptr;
};

}  // namespace perifrac
