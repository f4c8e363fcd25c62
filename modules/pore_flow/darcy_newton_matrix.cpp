#include "modules/pore_flow/darcy_newton_matrix.hpp"

#include "core/profile/profile.hpp"

namespace perifrac {

namespace {

/// GMRES takes the preconditioner for linear.
constexpr double iteration_tolerance = 1e-8;

}  // namespace

template <int D>
DarcyNewtonMatrix<D>::DarcyNewtonMatrix(DarcySystem<D>& system, Method method)
    : system_(system),
      method_(method),
      right_side_(system.points()),
      pressure_(system.points()),
      outflow_(system.points()) {
  iteration_.setTolerance(iteration_tolerance);
  assemble();
}

template <int D>
void DarcyNewtonMatrix<D>::assemble() {
  const ProfileScope profiled("assembly");
  const Eigen::SparseMatrix<double> all =
      method_ == Method::direct ? system_.flow().assemble() : system_.flow().preconditioner();
  flow_ = all.topLeftCorner(system_.points(), system_.points());
  if (exact()) system_.add_storage_pattern_to(flow_);
  face_flow_ = all.bottomLeftCorner(all.rows() - system_.points(), system_.points());
  matrix_ = flow_;
  face_outflow_.resize(face_flow_.rows());
  pattern_version_ = system_.pattern_version();
}

template <int D>
void DarcyNewtonMatrix<D>::set_up(double t, std::span<const double> y, double gamma) {
  if (pattern_version_ != system_.pattern_version()) assemble();
  gamma_ = gamma;
  matrix_.coeffs() = gamma * flow_.coeffs();
  for (const HeldPoint& held : system_.held_points()) uncouple(held.point);
  if (exact()) {
    system_.add_storage_to(matrix_, t, y);
    factor_.factor(matrix_);
    return;
  }
  const ProfileScope profiled("incomplete factorisation");
  const std::span<const double> storage = system_.effective_storage(t, y);
  for (Index i = 0; i < system_.points(); ++i) {
    matrix_.coeffRef(i, i) += system_.volume()[i] * storage[i];
  }
  iteration_.compute(matrix_);
}

template <int D>
void DarcyNewtonMatrix<D>::solve(std::span<const double> r, std::span<double> solution) {
  const Index points = system_.points();
  const std::vector<double>& volume = system_.volume();
  for (Index i = 0; i < points; ++i) right_side_[i] = volume[i] * r[i];
  for (const HeldPoint& held : system_.held_points()) right_side_[held.point] = 0.0;
  if (exact()) {
    factor_.solve(right_side_, pressure_);
  } else {
    const ProfileScope profiled("solves");
    pressure_ = iteration_.solve(right_side_);
  }
  outflow_.noalias() = flow_ * pressure_;
  face_outflow_.noalias() = face_flow_ * pressure_;
  for (Index i = 0; i < points; ++i) solution[i] = r[i] - gamma_ * outflow_[i] / volume[i];
  std::copy(r.begin() + points, r.end(), solution.begin() + points);
  for (Index f = 0; f < face_outflow_.size(); ++f) {
    solution[points + f] += gamma_ * face_outflow_[f];
  }
  for (const auto& [i, face_value] : system_.held_points()) {
    if (face_value >= 0) solution[points + face_value] += gamma_ * outflow_[i];
    solution[i] = r[i];
  }
}

template <int D>
void DarcyNewtonMatrix<D>::uncouple(Index i) {
  for (typename Eigen::SparseMatrix<double>::InnerIterator entry(flow_, i); entry; ++entry) {
    matrix_.coeffRef(entry.row(), i) = 0.0;
    matrix_.coeffRef(i, entry.row()) = 0.0;
  }
}

template class DarcyNewtonMatrix<2>;
template class DarcyNewtonMatrix<3>;

}  // namespace perifrac
