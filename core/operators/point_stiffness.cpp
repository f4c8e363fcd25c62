#include "core/operators/point_stiffness.hpp"

namespace perifrac {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// Lists of numbers, one after the other.
struct Lists {
  std::vector<Index> begin = {0};
  std::vector<Index> all;
  std::span<const Index> at(Index k) const {
    return std::span(all).subspan(begin[k], begin[k + 1] - begin[k]);
  }
  Index count() const { return static_cast<Index>(begin.size()) - 1; }
  void close() { begin.push_back(static_cast<Index>(all.size())); }
};

Lists unknowns_of_points(
    Index points,
    const std::function<void(Index i, std::vector<Index>& unknowns)>& append_unknowns) {
  Lists result;
  std::vector<Index> own;
  for (Index i = 0; i < points; ++i) {
    own.clear();
    append_unknowns(i, own);
    std::ranges::sort(own);
    const auto twice = std::ranges::unique(own);
    result.all.insert(result.all.end(), own.begin(), twice.begin());
    result.close();
  }
  return result;
}

/// The points of each unknown, ascending.
Lists turned(const Lists& unknowns, Index size) {
  Lists result;
  result.begin.assign(size + 1, 0);
  for (const Index k : unknowns.all) ++result.begin[k + 1];
  for (Index k = 0; k < size; ++k) result.begin[k + 1] += result.begin[k];
  result.all.resize(unknowns.all.size());
  std::vector<Index> next(result.begin.begin(), result.begin.end() - 1);
  for (Index i = 0; i < unknowns.count(); ++i) {
    for (const Index k : unknowns.at(i)) result.all[next[k]++] = i;
  }
  return result;
}

/// An entry of 0 for each two unknowns that a point has.
Matrix pattern(const Lists& unknowns, Index size) {
  const Lists points = turned(unknowns, size);
  std::vector<Index> column_of(size, -1), rows;
  std::vector<int> begin = {0}, entries;
  for (Index column = 0; column < size; ++column) {
    rows.clear();
    for (const Index i : points.at(column)) {
      for (const Index row : unknowns.at(i)) {
        if (column_of[row] == column) continue;
        column_of[row] = column;
        rows.push_back(row);
      }
    }
    std::ranges::sort(rows);
    entries.insert(entries.end(), rows.begin(), rows.end());
    begin.push_back(static_cast<int>(entries.size()));
  }
  Matrix result(size, size);
  result.resizeNonZeros(std::ssize(entries));
  std::ranges::copy(begin, result.outerIndexPtr());
  std::ranges::copy(entries, result.innerIndexPtr());
  std::fill_n(result.valuePtr(), entries.size(), 0.0);
  return result;
}

}  // namespace

Eigen::SparseMatrix<double> sum_of_points(
    Index size, Index points,
    const std::function<void(Index i, std::vector<Index>& unknowns)>& append_unknowns,
    const std::function<PointStiffness(Index i)>& stiffness) {
  Matrix sum = pattern(unknowns_of_points(points, append_unknowns), size);
  const int* const rows = sum.innerIndexPtr();
  for (Index i = 0; i < points; ++i) {
    const PointStiffness part = stiffness(i);
    for (std::size_t column = 0; column < part.unknowns.size(); ++column) {
      int entry = sum.outerIndexPtr()[part.unknowns[column]];
      for (std::size_t row = 0; row < part.unknowns.size(); ++row) {
        while (rows[entry] != part.unknowns[row]) ++entry;
        sum.valuePtr()[entry] += part.matrix(row, column);
      }
    }
  }
  return sum;
}

}  // namespace perifrac
