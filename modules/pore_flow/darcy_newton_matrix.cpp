#include "modules/pore_flow/darcy_newton_matrix.hpp"

#include "core/operators/nonlocal_gradient.hpp"

namespace perifrac {

namespace {

/// kappa sum_i V_i (D / m_i) sum_j w_ij (p_j - p_i)^2 / 2: Darcy flow on bonds alone.
template <int D>
Eigen::SparseMatrix<double> bond_flow(const DarcySystem<D>& system) {
  const Family<D>& family = system.flow().family();
  std::vector<double> stiffness(family.point_count);
  for (Index i = 0; i < family.point_count; ++i) {
    stiffness[i] = D * system.material().mobility / system.flow().weighted_volume(i);
  }
  return bond_matrix(family, system.flow().mirror(), std::span<const double>(stiffness));
}

}  // namespace

template <int D>
DarcyNewtonMatrix<D>::DarcyNewtonMatrix(DarcySystem<D>& system, Method method)
    : system_(system),
      method_(method),
      right_side_(system.points()),
      pressure_(system.points()),
      outflow_(system.flow().size()) {
  const Eigen::SparseMatrix<double> all =
      method == Method::direct ? system.flow().assemble() : bond_flow(system);
  flow_ = all.leftCols(system.points());
}

template <int D>
void DarcyNewtonMatrix<D>::set_up(double, std::span<const double>, double gamma) {
  gamma_ = gamma;
  Eigen::SparseMatrix<double> matrix = gamma * flow_.topRows(system_.points());
  for (Index i = 0; i < system_.points(); ++i) {
    matrix.coeffRef(i, i) += system_.volume()[i] * system_.effective_storage()[i];
  }
  factor_.factor(matrix);
}

template <int D>
void DarcyNewtonMatrix<D>::solve(std::span<const double> r, std::span<double> solution) {
  const Index points = system_.points();
  const std::vector<double>& volume = system_.volume();
  for (Index i = 0; i < points; ++i) right_side_[i] = volume[i] * r[i];
  factor_.solve(right_side_, pressure_);
  outflow_.noalias() = flow_ * pressure_;
  for (Index i = 0; i < points; ++i) solution[i] = r[i] - gamma_ * outflow_[i] / volume[i];
  for (Index k = points; k < outflow_.size(); ++k) solution[k] = r[k] + gamma_ * outflow_[k];
  for (std::size_t k = outflow_.size(); k < r.size(); ++k) solution[k] = r[k];
}

template class DarcyNewtonMatrix<2>;
template class DarcyNewtonMatrix<3>;

}  // namespace perifrac
