#pragma once

#include <algorithm>
#include <vector>

#include <Eigen/Core>

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
    for (Index b = family.offset[i]; b < family.offset[i + 1]; ++b) append(family.other[b]);
  }
}

/// A matrix on the nodes of a family, R blocks of (the bonds' other ends, then the point itself),
/// as one on the unknowns that these nodes follow from.
template <int D, int R>
PointStiffness on_unknowns(const Family<D>& family, const MirrorCondition<D, R>& mirror, Index i,
                           const Eigen::MatrixXd& nodes) {
  const Index first = family.offset[i];
  const Index bonds = family.offset[i + 1] - first;
  std::vector<Combination> ends;
  PointStiffness result;
  for (int r = 0; r < R; ++r) {
    for (Index b = 0; b <= bonds; ++b) {
      ends.push_back(node_unknowns(family, mirror, b < bonds ? family.other[first + b] : i, r));
      for (int k = 0; k < ends.back().count; ++k) {
        result.unknowns.push_back(ends.back().terms[k].unknown);
      }
    }
  }
  std::ranges::sort(result.unknowns);
  const auto twice = std::ranges::unique(result.unknowns);
  result.unknowns.erase(twice.begin(), twice.end());
  const auto place = [&](Index unknown) {
    return std::ranges::lower_bound(result.unknowns, unknown) - result.unknowns.begin();
  };
  Eigen::MatrixXd from_unknowns =
      Eigen::MatrixXd::Zero(nodes.rows(), static_cast<Eigen::Index>(result.unknowns.size()));
  for (std::size_t row = 0; row < ends.size(); ++row) {
    for (int k = 0; k < ends[row].count; ++k) {
      from_unknowns(row, place(ends[row].terms[k].unknown)) += ends[row].terms[k].coefficient;
    }
  }
  result.matrix = from_unknowns.transpose() * nodes * from_unknowns;
  return result;
}

}  // namespace perifrac
