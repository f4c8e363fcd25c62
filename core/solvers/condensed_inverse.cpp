#include "core/solvers/condensed_inverse.hpp"

#include <Eigen/Dense>

namespace perifrac {

namespace {

/// What is left of a stiffness, as a part of it, that counts as nothing.
constexpr double singular = 1e-12;

}  // namespace

CondensedInverse::CondensedInverse(const SparseCholesky& factor, Eigen::Index size)
    : factor_(factor), place_(size, -1) {}

void CondensedInverse::add(std::span<const int> unknowns) {
  const Eigen::Index before = block_.rows();
  for (const int unknown : unknowns) {
    if (place_[unknown] >= 0) continue;
    place_[unknown] = static_cast<int>(unknowns_.size());
    unknowns_.push_back(unknown);
  }
  const Eigen::Index all = static_cast<Eigen::Index>(unknowns_.size());
  const Eigen::Index added = all - before;
  if (added == 0) return;

  Eigen::MatrixXd columns(all, added);  // of A0^-1
  factor_.solve_part(std::span(unknowns_).subspan(before), Eigen::MatrixXd::Identity(added, added),
                     unknowns_, columns);

  const Eigen::MatrixXd old = columns.topRows(before);
  const Eigen::MatrixXd corrected = old - block_ * force_of_changes(old);
  const Eigen::MatrixXd own =
      columns.bottomRows(added) - old.transpose() * force_of_changes(corrected);
  block_.conservativeResize(all, all);
  block_.topRightCorner(before, added) = corrected;
  block_.bottomLeftCorner(added, before) = corrected.transpose();
  block_.bottomRightCorner(added, added) = 0.5 * (own + own.transpose());
}

void CondensedInverse::change(std::span<const int> places, const Eigen::MatrixXd& delta) {
  const Eigen::Index count = static_cast<Eigen::Index>(places.size());
  Eigen::MatrixXd columns(block_.rows(), count);
  for (Eigen::Index k = 0; k < count; ++k) columns.col(k) = block_.col(places[k]);
  Eigen::MatrixXd own(count, count);
  for (Eigen::Index k = 0; k < count; ++k) own.row(k) = columns.row(places[k]);
  Eigen::MatrixXd system = delta * own;
  system.diagonal().array() += 1.0;
  if (count == 0) return;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factored(system);
  const double size = system.cwiseAbs().colwise().sum().maxCoeff();
  if (!(factored.rcond() * size > singular)) throw NotPositiveDefinite(unknowns_[places[0]]);
  const Eigen::MatrixXd core = factored.solve(delta);
  const Eigen::MatrixXd symmetric = 0.5 * (core + core.transpose());
  block_.noalias() -= columns * (symmetric * columns.transpose());
  changes_.push_back({{places.begin(), places.end()}, delta});
}

Eigen::MatrixXd CondensedInverse::force_of_changes(const Eigen::MatrixXd& x) const {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (const auto& [places, delta] : changes_) {
    Eigen::MatrixXd part(delta.rows(), x.cols());
    for (Eigen::Index k = 0; k < part.rows(); ++k) part.row(k) = x.row(places[k]);
    const Eigen::MatrixXd product = delta * part;
    for (Eigen::Index k = 0; k < part.rows(); ++k) result.row(places[k]) += product.row(k);
  }
  return result;
}

Eigen::VectorXd CondensedInverse::correct_block(const Eigen::VectorXd& x0) const {
  return x0 - block_ * force_of_changes(x0);
}

}  // namespace perifrac
