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
/// Each is as long as the factor's matrix while it is found.
constexpr Eigen::Index columns_at_once = 64;

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
  if (all == before) return;

  Eigen::MatrixXd block(all, all);
  block.topLeftCorner(before, before) = block_;
  for (Eigen::Index first = before; first < all; first += columns_at_once) {
    find_columns(std::span(names).first(std::min(all, first + columns_at_once)), first, block);
  }
  block_.swap(block);
  unknowns_ = std::move(names);
  for (Eigen::Index k = before; k < all; ++k) place_[unknowns_[k]] = static_cast<int>(k);
}

/// Of `block`, those of `names` from `first` on, whose earlier part is known.
void CondensedInverse::find_columns(std::span<const int> names, Eigen::Index first,
                                    Eigen::MatrixXd& block) const {
  const Eigen::Index all = std::ssize(names), added = all - first;
  Eigen::MatrixXd columns(all, added);  // of A0^-1
  factor_.solve_part(names.subspan(first), Eigen::MatrixXd::Identity(added, added), names, columns);
  if (!changes_.empty()) {
    const Eigen::MatrixXd old = columns.topRows(first);
    columns.topRows(first) -= block.topLeftCorner(first, first) * force_of_changes(old);
    columns.bottomRows(added) -= old.transpose() * force_of_changes(columns.topRows(first));
  }
  const auto own = columns.bottomRows(added);
  block.block(0, first, first, added) = columns.topRows(first);
  block.block(first, 0, added, first) = columns.topRows(first).transpose();
  block.block(first, first, added, added) = 0.5 * (own + own.transpose());
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
