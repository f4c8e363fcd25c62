#pragma once

#include <span>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/solvers/sparse_cholesky.hpp"

namespace perifrac {

/// Unknowns, each with a coefficient, added up.
using UnknownSum = std::vector<std::pair<int, double>>;

/// The inverse of A = A0 + changes, where A0 is factored and the changes lie on few unknowns, which
/// come one after the other: a body while a crack grows through it. Kept as the dense block S of
/// A^-1 on all unknowns, and sums of unknowns, that were ever named, each change being a low-rank
/// correction of it (Sherman, Morrison and Woodbury), so that a change costs one back-substitution
/// a new unknown and no factorisation. A sum is one place where its unknowns would be many.
class CondensedInverse {
 public:
  /// Refers to the factor of A0 of `size` unknowns, which must stay as it is.
  CondensedInverse(const SparseCholesky& factor, Eigen::Index size);

  /// Place of an unknown in S, -1 where it has not been named by itself.
  int place(int unknown) const { return place_[unknown]; }
  /// Adds those that have no place yet; many at once cost less than one after the other, each of
  /// which copies the block.
  void add(std::span<const int> unknowns);
  /// Adds sums, which take the places behind those that there are.
  void add(std::span<const UnknownSum> sums);

  /// A += delta on the unknowns at these places, symmetric. Throws
  /// NotPositiveDefinite, with one of the unknowns, where that makes A singular.
  void change(std::span<const int> places, const Eigen::MatrixXd& delta);

  /// One of the changes, in their order: the places and what was added there.
  struct Change {
    std::vector<int> places;
    Eigen::MatrixXd delta;
  };
  std::span<const Change> changes() const { return changes_; }

  /// S, one row and column an unknown or a sum, in the order of their places.
  const Eigen::MatrixXd& block() const { return block_; }
  /// That places stand for, each once.
  std::span<const int> unknowns() const { return unknowns_; }
  /// What places are where unknowns() are this.
  Eigen::VectorXd at_places(const Eigen::VectorXd& of_unknowns) const;
  /// What forces on places are on unknowns(), a column each.
  Eigen::MatrixXd on_unknowns(const Eigen::MatrixXd& of_places) const;

  /// The block's part of A^-1 b from that of A0^-1 b, at no back-substitution.
  Eigen::VectorXd correct_block(const Eigen::VectorXd& x0) const;
  /// What the changes do where the block's part of x is this, both on the block, a column each:
  /// A x = A0 x + that.
  Eigen::MatrixXd force_of_changes(const Eigen::MatrixXd& block) const;

 private:
  /// What a place stands for.
  struct Place {
    UnknownSum sum;      ///< of numbers in unknowns()
    Eigen::Index reach;  ///< how many of them it and all places before it stand for
  };
  void name(std::span<const UnknownSum> sums);
  Eigen::MatrixXd columns_of_first(Eigen::Index first, Eigen::Index last) const;
  void find_columns(Eigen::Index first, Eigen::Index last, Eigen::MatrixXd& block) const;

  const SparseCholesky& factor_;
  std::vector<int> place_;   ///< by unknown
  std::vector<int> number_;  ///< by unknown: in unknowns_, -1: it is not there
  std::vector<int> unknowns_;
  std::vector<Place> places_;
  std::vector<Change> changes_;
  int named_by_changes_ = 0;  ///< places below this
  Eigen::MatrixXd block_;
};

}  // namespace perifrac
