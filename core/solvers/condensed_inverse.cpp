#include "core/solvers/condensed_inverse.hpp"

#include <algorithm>
#include <map>
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

}  // namespace

CondensedInverse::CondensedInverse(const SparseCholesky& factor, Eigen::Index size)
    : factor_(factor), place_(size, -1), number_(size, -1) {}

void CondensedInverse::add(std::span<const int> unknowns) {
  std::vector<UnknownSum> sums;
  std::set<int> known;
  for (const int unknown : unknowns) {
    require(unknown >= 0 && unknown < std::ssize(place_), "an unknown that the factor has not");
    if (place_[unknown] < 0 && known.insert(unknown).second) sums.push_back({{unknown, 1.0}});
  }
  auto next = static_cast<int>(block_.rows());
  add(sums);
  for (const UnknownSum& sum : sums) place_[sum[0].first] = next++;
}

void CondensedInverse::add(std::span<const UnknownSum> sums) {
  if (sums.empty()) return;
  const Eigen::Index before = block_.rows();
  try {
    name(sums);
    const Eigen::Index all = std::ssize(places_);
    Eigen::MatrixXd block(all, all);
    block.topLeftCorner(before, before) = block_;
    for (Eigen::Index first = before; first < all; first += columns_at_once) {
      find_columns(first, std::min(all, first + columns_at_once), block);
    }
    block_.swap(block);
  } catch (...) {  // there may be no memory for them
    places_.resize(before);
    while (std::ssize(unknowns_) > (before > 0 ? places_.back().reach : 0)) {
      number_[unknowns_.back()] = -1;
      unknowns_.pop_back();
    }
    throw;
  }
}

void CondensedInverse::name(std::span<const UnknownSum> sums) {
  for (const UnknownSum& sum : sums) {
    UnknownSum numbered;
    for (const auto& [unknown, coefficient] : sum) {
      require(unknown >= 0 && unknown < std::ssize(number_), "an unknown that the factor has not");
      if (number_[unknown] < 0) {
        number_[unknown] = static_cast<int>(unknowns_.size());
        unknowns_.push_back(unknown);
      }
      numbered.emplace_back(number_[unknown], coefficient);
    }
    places_.push_back({std::move(numbered), std::ssize(unknowns_)});
  }
}

/// At the places up to `last`, what A0^-1 does to those from `first` on, a column each.
Eigen::MatrixXd CondensedInverse::columns_of_first(Eigen::Index first, Eigen::Index last) const {
  std::vector<int> rows;
  std::map<int, Eigen::Index> row_of;
  for (Eigen::Index k = first; k < last; ++k) {
    for (const auto& [number, coefficient] : places_[k].sum) {
      if (row_of.emplace(number, std::ssize(rows)).second) rows.push_back(unknowns_[number]);
    }
  }
  Eigen::MatrixXd force = Eigen::MatrixXd::Zero(std::ssize(rows), last - first);
  for (Eigen::Index k = first; k < last; ++k) {
    for (const auto& [number, coefficient] : places_[k].sum)
      force(row_of[number], k - first) += coefficient;
  }
  Eigen::MatrixXd moved(places_[last - 1].reach, last - first);
  factor_.solve_part(rows, force, std::span(unknowns_).first(moved.rows()), moved);
  Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(last, last - first);
  for (Eigen::Index k = 0; k < last; ++k) {
    for (const auto& [number, coefficient] : places_[k].sum)
      columns.row(k) += coefficient * moved.row(number);
  }
  return columns;
}

/// Of `block`, those from `first` on, whose earlier part is known.
void CondensedInverse::find_columns(Eigen::Index first, Eigen::Index last,
                                    Eigen::MatrixXd& block) const {
  const Eigen::Index added = last - first;
  Eigen::MatrixXd columns = columns_of_first(first, last);
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

Eigen::VectorXd CondensedInverse::at_places(const Eigen::VectorXd& of_unknowns) const {
  require(of_unknowns.size() == std::ssize(unknowns_), "other unknowns than places stand for");
  Eigen::VectorXd of_places = Eigen::VectorXd::Zero(block_.rows());
  for (Eigen::Index k = 0; k < of_places.size(); ++k) {
    for (const auto& [number, coefficient] : places_[k].sum)
      of_places[k] += coefficient * of_unknowns[number];
  }
  return of_places;
}

Eigen::MatrixXd CondensedInverse::on_unknowns(const Eigen::MatrixXd& of_places) const {
  require(of_places.rows() == block_.rows(), "a part of the block's places");
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(std::ssize(unknowns_), of_places.cols());
  for (Eigen::Index k = 0; k < of_places.rows(); ++k) {
    for (const auto& [number, coefficient] : places_[k].sum)
      result.row(number) += coefficient * of_places.row(k);
  }
  return result;
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
  if (!(factored.rcond() * size > singular)) {
    throw NotPositiveDefinite(unknowns_[places_[places[0]].sum[0].first]);
  }
  const Eigen::MatrixXd core = factored.solve(delta);
  const Eigen::MatrixXd symmetric = 0.5 * (core + core.transpose());
  changes_.push_back({{places.begin(), places.end()}, delta});
  named_by_changes_ = std::max(named_by_changes_, std::ranges::max(places) + 1);
  block_.noalias() -= columns * (symmetric * columns.transpose());
}

Eigen::MatrixXd CondensedInverse::force_of_changes(const Eigen::MatrixXd& x) const {
  require(x.rows() >= named_by_changes_, "a part of the block's places");
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
  require(x0.size() == block_.rows(), "a part of the block's places");
  return x0 - block_ * force_of_changes(x0);
}

}  // namespace perifrac
