#include "core/solvers/reduced_matrix.hpp"

#include <algorithm>
#include <cassert>
#include <vector>

namespace perifrac {

namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// The one entry of each row: its column, -1 where there is none, and its value.
struct RowEntries {
  explicit RowEntries(const Matrix& t) : column(t.rows(), -1), value(t.rows(), 0.0) {
    for (int c = 0; c < t.outerSize(); ++c) {
      for (Matrix::InnerIterator entry(t, c); entry; ++entry) {
        assert(column[entry.row()] < 0);
        column[entry.row()] = c;
        value[entry.row()] = entry.value();
      }
    }
  }
  std::vector<int> column;
  std::vector<double> value;
};

}  // namespace

Matrix reduced(const Matrix& a, const Matrix& t) {
  using Entry = Matrix::InnerIterator;
  assert(a.rows() == a.cols() && a.rows() == t.rows() && a.isCompressed());
  const RowEntries of_row(t);
  Matrix result(t.cols(), t.cols());
  result.resizeNonZeros(a.nonZeros());
  std::vector<int> seen_in(t.cols(), -1), rows;
  std::vector<double> sum(t.cols());
  int count = 0;
  for (int column = 0; column < t.outerSize(); ++column) {
    rows.clear();
    for (Entry from(t, column); from; ++from) {
      for (Entry entry(a, static_cast<int>(from.row())); entry; ++entry) {
        const int row = of_row.column[entry.row()];
        if (row < 0) continue;
        if (seen_in[row] != column) {
          seen_in[row] = column;
          sum[row] = 0.0;
          rows.push_back(row);
        }
        sum[row] += of_row.value[entry.row()] * entry.value() * from.value();
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
