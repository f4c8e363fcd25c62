#pragma once

#include <Eigen/Core>

namespace perifrac::test {

/// Columns of length 1, normal to each other, by Gram and Schmidt; twice, which leaves rounding.
template <int D>
Eigen::Matrix<double, D, D> orthonormal(Eigen::Matrix<double, D, D> columns) {
  for (int turn = 0; turn < 2; ++turn) {
    for (int a = 0; a < D; ++a) {
      for (int b = 0; b < a; ++b)
        columns.col(a) -= columns.col(b).dot(columns.col(a)) * columns.col(b);
      columns.col(a).normalize();
    }
  }
  return columns;
}

}  // namespace perifrac::test
