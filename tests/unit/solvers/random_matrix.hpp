#pragma once

#include <random>

#include <Eigen/Core>

namespace perifrac::test {

/// Entries between -1 and 1.
inline Eigen::MatrixXd random_matrix(int rows, int columns, unsigned seed) {
  std::mt19937 bits(seed);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return value(bits); });
}

}  // namespace perifrac::test
