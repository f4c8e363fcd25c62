#include "modules/pore_flow/darcy_preconditioner.hpp"

#include <utility>
#include <vector>

#include "core/profile/profile.hpp"

namespace perifrac {

template <int D>
DarcyPreconditioner<D>::DarcyPreconditioner(DarcySystem<D>& system)
    : system_(system),
      storage_(system.points()),
      poured_(system.points()),
      right_side_(system.points()),
      pressure_(system.points()) {
  assemble();
}

template <int D>
void DarcyPreconditioner<D>::assemble() {
  const ProfileScope profiled("assembly");
  const Index points = system_.points();
  Eigen::SparseMatrix<double> flow;
  {
    const Eigen::SparseMatrix<double> all = system_.flow().preconditioner();
    flow = all.topLeftCorner(points, points);
    face_flow_ = all.topRightCorner(points, all.cols() - points);
  }
  take_held_flow(flow);
  let_in_ = face_flow_ * Eigen::VectorXd::Ones(face_flow_.cols()) +
            held_flow_ * Eigen::VectorXd::Ones(held_flow_.cols());
  std::vector<bool> is_held(points, false);
  for (const HeldPoint& held : system_.held_points()) {
    is_held[held.point] = true;
    let_in_[held.point] = 0.0;
  }
  multigrid_ = std::make_unique<FlowMultigrid>(std::move(flow), std::move(is_held));
  pattern_version_ = system_.pattern_version();
}

template <int D>
void DarcyPreconditioner<D>::take_held_flow(const Eigen::SparseMatrix<double>& flow) {
  std::vector<Eigen::Triplet<double>> entries;
  int column = 0;
  for (const HeldPoint& held : system_.held_points()) {
    for (Eigen::SparseMatrix<double>::InnerIterator entry(flow, held.point); entry; ++entry) {
      entries.emplace_back(entry.row(), column, entry.value());
    }
    ++column;
  }
  held_flow_.resize(flow.rows(), column);
  held_flow_.setFromTriplets(entries.begin(), entries.end());
}

template <int D>
void DarcyPreconditioner<D>::set_up(double t, std::span<const double> y, double gamma) {
  if (pattern_version_ != system_.pattern_version()) assemble();
  const ProfileScope profiled("multigrid");
  gamma_ = gamma;
  const std::span<const double> storage = system_.effective_storage(t, y);
  for (Index i = 0; i < system_.points(); ++i) storage_[i] = system_.volume()[i] * storage[i];
  multigrid_->set(storage_, gamma);
  for (const HeldPoint& held : system_.held_points()) storage_[held.point] = 0.0;
  kept_ = storage_ - gamma * let_in_;
  multigrid_->apply(storage_, poured_);
  poured_volume_ = kept_.dot(poured_);
}

template <int D>
void DarcyPreconditioner<D>::solve(std::span<const double> r, std::span<double> solution) {
  const ProfileScope profiled("solves");
  const Index points = system_.points();
  const std::vector<double>& volume = system_.volume();
  for (Index i = 0; i < points; ++i) right_side_[i] = volume[i] * r[i];
  for (const HeldPoint& held : system_.held_points()) right_side_[held.point] = 0.0;
  multigrid_->apply(right_side_, pressure_);
  const double lost = right_side_.sum() - kept_.dot(pressure_);
  pressure_ += lost / poured_volume_ * poured_;
  for (Index i = 0; i < points; ++i) solution[i] = storage_[i] * pressure_[i] / volume[i];
  std::copy(r.begin() + points, r.end(), solution.begin() + points);
  face_inflow_.noalias() = face_flow_.transpose() * pressure_;
  for (Index f = 0; f < face_inflow_.size(); ++f) solution[points + f] += gamma_ * face_inflow_[f];
  held_outflow_.noalias() = held_flow_.transpose() * pressure_;
  const auto held_points = system_.held_points();
  for (std::size_t k = 0; k < held_points.size(); ++k) {
    const auto& [i, face_value] = held_points[k];
    if (face_value >= 0) solution[points + face_value] += gamma_ * held_outflow_[k];
    solution[i] = r[i];
  }
}

template class DarcyPreconditioner<2>;
template class DarcyPreconditioner<3>;

}  // namespace perifrac
