#include "core/solvers/reduced_matrix.hpp"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

Matrix banded(int size, int band) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) {
    for (int j = std::max(0, i - band); j <= std::min(size - 1, i + band); ++j) {
      entries.emplace_back(i, j, std::sin(1.0 + 3.1 * (i + j) + 0.7 * i * j));
    }
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(ReducedMatrix, IsTheProduct) {
  const int size = 40;
  const Matrix a = banded(size, 6);
  std::vector<Eigen::Triplet<double>> some, turned, alike;
  for (int i = 0; i < size; ++i) {
    if (i % 5 > 0) some.emplace_back(i, i - i / 5 - 1, 1.0);
    turned.emplace_back(i, size - 1 - i, 0.5 + i);
    if (i % 7 > 0) alike.emplace_back(i, i % 3, i % 2 == 0 ? -1.0 : 2.0);
  }
  for (const auto& [columns, entries] :
       {std::pair(size - 8, some), std::pair(size, turned), std::pair(4, alike)}) {
    Matrix t(size, columns);
    t.setFromTriplets(entries.begin(), entries.end());
    const Matrix found = reduced(a, t);
    ASSERT_EQ(found.rows(), columns);
    ASSERT_TRUE(found.isCompressed());
    const Eigen::MatrixXd expected = Eigen::MatrixXd(t.transpose() * a * t);
    EXPECT_LT((Eigen::MatrixXd(found) - expected).norm(), 1e-14 * expected.norm());
    for (int column = 0; column < found.cols(); ++column) {
      int last = -1;
      for (Matrix::InnerIterator entry(found, column); entry; ++entry) {
        EXPECT_LT(last, entry.row());
        last = static_cast<int>(entry.row());
      }
    }
  }
}

}  // namespace
}  // namespace perifrac
