#include "core/solvers/band_lu.hpp"

#include <algorithm>
#include <numeric>
#include <random>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// A band whose diagonal is small, so that rows must be exchanged, its unknowns shuffled.
TEST(BandLu, SolvesABandInAnyOrder) {
  const int size = 40, width = 3;
  std::mt19937 bits(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  std::vector<Index> order(size);
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), bits);
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int row = 0; row < size; ++row) {
    for (int column = std::max(0, row - width); column <= std::min(size - 1, row + width);
         ++column) {
      matrix(order[row], order[column]) = row == column ? 1e-9 * value(bits) : value(bits);
    }
  }
  EXPECT_EQ(half_bandwidth(matrix, order), width);
  const Eigen::VectorXd right = Eigen::VectorXd::LinSpaced(size, -1.0, 2.0);
  const Eigen::VectorXd x = solve_band(matrix, order, width, right);
  EXPECT_LE((matrix * x - right).cwiseAbs().maxCoeff(), 1e-10);
}

}  // namespace
}  // namespace perifrac
