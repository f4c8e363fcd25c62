#include "modules/pore_flow/darcy_factor.hpp"

#include "core/profile/profile.hpp"

namespace perifrac {

template <int D>
DarcyFactor<D>::DarcyFactor(DarcySystem<D>& system)
    : system_(system),
      right_side_(system.points()),
      pressure_(system.points()),
      outflow_(system.points()) {
  assemble();
}

template <int D>
void DarcyFactor<D>::assemble() {
  const ProfileScope profiled("assembly");
  const Eigen::SparseMatrix<double> all = system_.flow().assemble();
  flow_ = all.topLeftCorner(system_.points(), system_.points());
  system_.add_storage_pattern_to(flow_);
  face_flow_ = all.bottomLeftCorner(all.rows() - system_.points(), system_.points());
  matrix_ = flow_;
  face_outflow_.resize(face_flow_.rows());
  pattern_version_ = system_.pattern_version();
}

template <int D>
void DarcyFactor<D>::set_up(double t, std::span<const double> y, double gamma) {
  if (pattern_version_ != system_.pattern_version()) assemble();
  gamma_ = gamma;
  matrix_.coeffs() = gamma * flow_.coeffs();
  for (const HeldPoint& held : system_.held_points()) uncouple(held.point);
  system_.add_storage_to(matrix_, t, y);
  factor_.factor(matrix_);
}

template <int D>
void DarcyFactor<D>::solve(std::span<const double> r, std::span<double> solution) {
  const Index points = system_.points();
  const std::vector<double>& volume = system_.volume();
  for (Index i = 0; i < points; ++i) right_side_[i] = volume[i] * r[i];
  for (const HeldPoint& held : system_.held_points()) right_side_[held.point] = 0.0;
  factor_.solve(right_side_, pressure_);
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
void DarcyFactor<D>::uncouple(Index i) {
  for (typename Eigen::SparseMatrix<double>::InnerIterator entry(flow_, i); entry; ++entry) {
    matrix_.coeffRef(entry.row(), i) = 0.0;
    matrix_.coeffRef(i, entry.row()) = 0.0;
  }
}

template class DarcyFactor<2>;
template class DarcyFactor<3>;

}  // namespace perifrac
