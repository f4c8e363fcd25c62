#include "core/solvers/condensed_inverse.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include <Eigen/Dense>

#include "core/base/require.hpp"

namespace perifrac {

namespace {

/// What is left of a stiffness, as a part of it, that counts as nothing.
constexpr double singular = 1e-12;

/// Drops what comes again from `first` on; order counts.
void keep_first_of_each(std::vector<int>& names, Eigen::Index first) {
  std::set<int> known;
  names.erase(std::remove_if(names.begin() + first, names.end(),
                             [&](int name) { return !known.insert(name).second; }),
              names.end());
}

}  // namespace

CondensedInverse::CondensedInverse(const SparseCholesky& factor, Eigen::Index size)
    : factor_(factor), place_(size, -1) {}

void CondensedInverse::add(std::span<const int> unknowns) {
  const Eigen::Index before = block_.rows();
  std::vector<int> names = unknowns_;
  for (const int unknown : unknowns) {
    require(unknown >= 0 && unknown < std::ssize(place_), "an unknown that the factor has not");
    if (place_[unknown] < 0) names.push_back(unknown);
  }
  keep_first_of_each(names, before);
  const Eigen::Index all = std::ssize(names);
  const Eigen::Index added = all - before;
  if (added == 0) return;

  Eigen::MatrixXd columns(all, added);  // of A0^-1
  factor_.solve_part(std::span(names).subspan(before), Eigen::MatrixXd::Identity(added, added),
                     names, columns);

  const Eigen::MatrixXd old = columns.topRows(before);
  const Eigen::MatrixXd corrected = old - block_ * force_of_changes(old);
  const Eigen::MatrixXd own =
      columns.bottomRows(added) - old.transpose() * force_of_changes(corrected);
  block_.conservativeResize(all, all);
  block_.topRightCorner(before, added) = corrected;
  block_.bottomLeftCorner(added, before) = corrected.transpose();
  block_.bottomRightCorner(added, added) = 0.5 * (own + own.transpose());
  unknowns_ = std::move(names);
  for (Eigen::Index k = before; k < all; ++k) place_[unknowns_[k]] = static_cast<int>(k);
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
  changes_.push_back({{places.begin(), places.end()}, delta});
  named_by_changes_ = std::max(named_by_changes_, std::ranges::max(places) + 1);
  block_.noalias() -= columns * (symmetric * columns.transpose());
}

Eigen::MatrixXd CondensedInverse::force_of_changes(const Eigen::MatrixXd& x) const {
  require(x.rows() >= named_by_changes_, "a part of the block's unknowns");
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
  require(x0.size() == block_.rows(), "a part of the block's unknowns");
  return x0 - block_ * force_of_changes(x0);
}

}  // namespace perifrac
