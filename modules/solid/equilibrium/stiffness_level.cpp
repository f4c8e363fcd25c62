#include "modules/solid/equilibrium/stiffness_level.hpp"

#include "core/base/eigen_view.hpp"

namespace perifrac {

template <int D>
StiffnessLevel<D>::StiffnessLevel(std::shared_ptr<ElasticOperator<D>> elastic,
                                  std::vector<bool> held, Eigen::VectorXd inverse_diagonal)
    : elastic_(std::move(elastic)), inverse_diagonal_(std::move(inverse_diagonal)) {
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (held[k]) held_.push_back(static_cast<Index>(k));
  }
}

template <int D>
void StiffnessLevel<D>::hold(Eigen::VectorXd& u) const {
  for (const Index k : held_) u[k] = 0.0;
}

template <int D>
void StiffnessLevel<D>::apply(const Eigen::VectorXd& u, Eigen::VectorXd& result) {
  elastic_->apply_stiffness(view(u), view(result));
  hold(result);
}

template <int D>
void StiffnessLevel<D>::restrict_residual(const Eigen::VectorXd& residual,
                                          Eigen::VectorXd& coarse) const {
  way_->restrict(residual, coarse);
  coarser_->hold(coarse);
}

template <int D>
void StiffnessLevel<D>::add_correction(const Eigen::VectorXd& coarse, Eigen::VectorXd& u) const {
  way_->add(coarse, u);
  hold(u);
}

template <int D>
Eigen::SparseMatrix<double> StiffnessLevel<D>::assemble() const {
  Eigen::SparseMatrix<double> matrix = elastic_->assemble();
  std::vector<bool> held(matrix.cols(), false);
  for (const Index k : held_) held[k] = true;
  matrix.prune([&](Eigen::Index row, Eigen::Index column, double) {
    return row == column || !(held[row] || held[column]);
  });
  for (const Index k : held_) matrix.coeffRef(k, k) = 1.0;
  matrix.makeCompressed();
  return matrix;
}

template class StiffnessLevel<2>;
template class StiffnessLevel<3>;

}  // namespace perifrac
