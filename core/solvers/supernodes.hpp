#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Core>

namespace perifrac {

/// A supernodal Cholesky factor L of P A P^T, without its values: supernode s has the columns
/// columns[s] to columns[s + 1], and as rows these and then those below, ascending, from
/// rows[rows_begin[s]] on; its values are dense, by column, from values_begin[s] on. In the
/// elimination tree it leads up to the supernode of its first row below.
struct Supernodes {
  std::span<const int> columns;
  std::span<const int> rows_begin;
  std::span<const int> values_begin;
  std::span<const int> rows;
  std::span<const int> permutation;  ///< by row of P A P^T, that of A

  int count() const { return static_cast<int>(std::ssize(columns)) - 1; }
  int width(int s) const { return columns[s + 1] - columns[s]; }
  int height(int s) const { return rows_begin[s + 1] - rows_begin[s]; }
  std::int64_t size(int s) const { return std::int64_t{width(s)} * height(s); }
  std::span<const int> below(int s) const {
    return rows.subspan(rows_begin[s] + width(s), height(s) - width(s));
  }

  /// By row of P A P^T, the supernode whose own it is.
  std::vector<int> supernode_of() const {
    std::vector<int> result(permutation.size());
    for (int s = 0; s < count(); ++s)
      std::fill(result.begin() + columns[s], result.begin() + columns[s + 1], s);
    return result;
  }

  /// The rows of the supernode's own columns in a vector or matrix of all.
  template <class All>
  auto own(All&& all, int s) const {
    return all.middleRows(columns[s], width(s));
  }

  /// What is known of the rows above acts on these: `solved` is own() of the right-hand side, and
  /// then of L^-1 times it; `change` is to be taken from the rows below.
  template <class Solved, class Change>
  void eliminate(const double* values, int s, Solved solved, Change change) const {
    triangle(values, s).template triangularView<Eigen::Lower>().solveInPlace(solved);
    change.noalias() = others(values, s) * solved;
  }

  /// The way back, where `known` is the solution in the rows below.
  template <class Solved, class Known>
  void substitute(const double* values, int s, Solved solved, const Known& known) const {
    solved.noalias() -= others(values, s).transpose() * known;
    triangle(values, s).transpose().template triangularView<Eigen::Upper>().solveInPlace(solved);
  }

 private:
  using Block = Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

  Block triangle(const double* values, int s) const {
    return {values + values_begin[s], width(s), width(s), Eigen::OuterStride<>(height(s))};
  }
  Block others(const double* values, int s) const {
    return {values + values_begin[s] + width(s), height(s) - width(s), width(s),
            Eigen::OuterStride<>(height(s))};
  }
};

}  // namespace perifrac
