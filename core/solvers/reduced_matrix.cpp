#include "core/solvers/reduced_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

namespace perifrac {

Eigen::SparseMatrix<double> reduced(const Eigen::SparseMatrix<double>& a,
                                    const Eigen::SparseMatrix<double>& t) {
  using Entry = Eigen::SparseMatrix<double>::InnerIterator;
  assert(a.rows() == a.cols() && a.rows() == t.rows() && a.isCompressed());
  std::vector<int> column_of(t.rows(), -1);
  std::vector<double> factor(t.rows(), 0.0);
  for (int column = 0; column < t.outerSize(); ++column) {
    for (Entry entry(t, column); entry; ++entry) {
      assert(column_of[entry.row()] < 0);
      column_of[entry.row()] = column;
      factor[entry.row()] = entry.value();
    }
  }

  Eigen::SparseMatrix<double> result(t.cols(), t.cols());
  result.resizeNonZeros(a.nonZeros());
  std::vector<int> seen_in(t.cols(), -1), rows;
  std::vector<double> sum(t.cols());
  int count = 0;
  for (int column = 0; column < t.outerSize(); ++column) {
    rows.clear();
    for (Entry from(t, column); from; ++from) {
      for (Entry entry(a, static_cast<int>(from.row())); entry; ++entry) {
        const int row = column_of[entry.row()];
        if (row < 0) continue;
        if (seen_in[row] != column) {
          seen_in[row] = column;
          sum[row] = 0.0;
          rows.push_back(row);
        }
        sum[row] += factor[entry.row()] * entry.value() * from.value();
      }
    }
    if (!std::ranges::is_sorted(rows)) std::ranges::sort(rows);
    for (const int row : rows) {
      result.innerIndexPtr()[count] = row;
      result.valuePtr()[count++] = sum[row];
    }
    result.outerIndexPtr()[column + 1] = count;
  }
  result.resizeNonZeros(count);
  return result;
}

}  // namespace perifrac
