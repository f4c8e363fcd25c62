#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include "core/operators/node_unknowns.hpp"

namespace perifrac {

/// What one point's energy adds to a stiffness: symmetric, on the unknowns of its family.
struct PointStiffness {
  std::vector<Index> unknowns;  ///< ascending
  Eigen::MatrixXd matrix;
};

/// Adds the unknowns that the nodes of a family follow from.
template <int D, int R>
void append_family_unknowns(const Family<D>& family, const MirrorCondition<D, R>& mirror, Index i,
                            std::vector<Index>& unknowns) {
  for (int r = 0; r < R; ++r) {
    const auto append = [&](Index node) {
      const Combination end = node_unknowns(family, mirror, node, r);
      for (int k = 0; k < end.count; ++k) unknowns.push_back(end.terms[k].unknown);
    };
    append(i);
    for (const auto& bond : family.bonds(i)) append(bond.other);
  }
}

/// A matrix on the nodes of a family, R blocks of (the bonds' other ends, then the point itself),
/// as one on the unknowns that these nodes follow from.
template <int D, int R>
PointStiffness on_unknowns(const Family<D>& family, const MirrorCondition<D, R>& mirror, Index i,
                           const Eigen::MatrixXd& nodes) {
  const PointBonds bonds = family.bonds(i);
  std::vector<Combination> ends;
  PointStiffness result;
  for (int r = 0; r < R; ++r) {
    for (Index b = 0; b <= bonds.count(); ++b) {
      ends.push_back(node_unknowns(family, mirror, b < bonds.count() ? bonds.other(b) : i, r));
      for (int k = 0; k < ends.back().count; ++k) {
        result.unknowns.push_back(ends.back().terms[k].unknown);
      }
    }
  }
  std::ranges::sort(result.unknowns);
  const auto twice = std::ranges::unique(result.unknowns);
  result.unknowns.erase(twice.begin(), twice.end());
  struct Term {
    Eigen::Index node, place;
    double coefficient;
  };
  std::vector<Term> terms;  // of all ends
  for (std::size_t node = 0; node < ends.size(); ++node) {
    for (int k = 0; k < ends[node].count; ++k) {
      const auto [unknown, coefficient] = ends[node].terms[k];
      const auto place = std::ranges::lower_bound(result.unknowns, unknown);
      terms.push_back(
          {static_cast<Eigen::Index>(node), place - result.unknowns.begin(), coefficient});
    }
  }
  const auto size = std::ssize(result.unknowns);
  result.matrix.setZero(size, size);
  for (const Term& right : terms) {
    const double* const from = nodes.col(right.node).data();
    double* const to = result.matrix.col(right.place).data();
    for (const Term& left : terms)
      to[left.place] += from[left.node] * right.coefficient * left.coefficient;
  }
  return result;
}

/// What points 0 to `points` add to a matrix of `size`, summed; both halves, and of every point's
/// unknowns the whole diagonal, zeros too. `append_unknowns(i, unknowns)` adds those of
/// `stiffness(i)`, in any order.
Eigen::SparseMatrix<double> sum_of_points(
    Index size, Index points,
    const std::function<void(Index i, std::vector<Index>& unknowns)>& append_unknowns,
    const std::function<PointStiffness(Index i)>& stiffness);

/// The same of what an operator's append_unknowns() and point_stiffness() say.
template <class Operator>
Eigen::SparseMatrix<double> sum_of_points(const Operator& op, Index points) {
  return sum_of_points(
      op.size(), points,
      [&](Index i, std::vector<Index>& unknowns) { op.append_unknowns(i, unknowns); },
      [&](Index i) { return op.point_stiffness(i); });
}

}  // namespace perifrac
