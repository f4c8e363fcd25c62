#include "core/solvers/sparse_cholesky.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Cholesky>
#include <gtest/gtest.h>
#include <omp.h>

// Not there where the program is built without OpenBLAS.
extern "C" [[gnu::weak]] char* openblas_get_corename();

namespace perifrac {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// shift I + a graph Laplacian on a grid, each point joined to all within `reach` columns and rows:
/// positive definite for shift > 0. The full matrix.
Matrix grid_laplacian(int side, int reach, double shift) {
  const int n = side * side;
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    entries.emplace_back(i, i, shift);
    for (int j = 0; j < i; ++j) {
      const int dx = std::abs(i % side - j % side), dy = std::abs(i / side - j / side);
      if (dx > reach || dy > reach) continue;
      const double weight = 1.0 / (dx * dx + dy * dy) + 0.01 * ((i + j) % 7);
      entries.emplace_back(i, j, -weight);
      entries.emplace_back(j, i, -weight);
      entries.emplace_back(i, i, weight);
      entries.emplace_back(j, j, weight);
    }
  }
  Matrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

Eigen::MatrixXd right_hand_sides(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd b(rows, columns);
  for (Eigen::Index j = 0; j < columns; ++j)
    for (Eigen::Index i = 0; i < rows; ++i) b(i, j) = std::sin(1.0 + 0.7 * i + 3.1 * j);
  return b;
}

double relative_difference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b) {
  return (a - b).norm() / b.norm();
}

#if defined(__x86_64__)
TEST(SparseCholesky, RunsOnTheInstructionsOfThisProcessor) {
  if (openblas_get_corename == nullptr) GTEST_SKIP() << "built without OpenBLAS";
  if (std::getenv("OPENBLAS_CORETYPE") != nullptr) GTEST_SKIP() << "the environment chooses";
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    GTEST_SKIP() << "no better instructions here";
  SparseCholesky cholesky;
  cholesky.factor(grid_laplacian(3, 1, 0.5));
  EXPECT_NE(openblas_get_corename(), std::string("Prescott"));
}
#endif

TEST(SparseCholesky, AgreesWithDenseForOneAndForManyRightHandSides) {
  const Matrix a = grid_laplacian(12, 3, 0.5);
  const Eigen::LLT<Eigen::MatrixXd> dense{Eigen::MatrixXd(a)};
  SparseCholesky cholesky;
  cholesky.factor(a);

  const Eigen::MatrixXd b = right_hand_sides(a.rows(), 5);
  Eigen::MatrixXd x(a.rows(), 5);
  cholesky.solve(b, x);
  EXPECT_LT(relative_difference(x, dense.solve(b)), 1e-13);

  Eigen::VectorXd one(a.rows());
  cholesky.solve(b.col(2), one);
  EXPECT_LT(relative_difference(one, dense.solve(b.col(2))), 1e-13);
}

TEST(SparseCholesky, WritesIntoPartOfALargerArrayAndNowhereElse) {
  const Matrix a = grid_laplacian(6, 2, 1.0);
  const Eigen::Index n = a.rows();
  SparseCholesky cholesky;
  cholesky.factor(a);
  const Eigen::MatrixXd b = right_hand_sides(n + 4, 3);
  Eigen::MatrixXd x = Eigen::MatrixXd::Constant(n + 4, 3, 7.0);
  cholesky.solve(b.middleRows(1, n), x.middleRows(2, n));
  EXPECT_LT(relative_difference(a * x.middleRows(2, n), b.middleRows(1, n)), 1e-13);
  EXPECT_TRUE((x.topRows(2).array() == 7.0).all());
  EXPECT_TRUE((x.bottomRows(2).array() == 7.0).all());
}

/// Rows far apart, close together and all of them; one right-hand side and many, in turn, so that
/// nothing may be left of the call before.
TEST(SparseCholesky, SolvesForAPartAsForAll) {
  const Matrix a = grid_laplacian(30, 2, 0.1);
  SparseCholesky cholesky;
  cholesky.factor(a);
  std::vector<int> all(a.rows());
  for (int k = 0; k < a.rows(); ++k) all[k] = k;
  const std::vector<std::vector<int>> parts = {{451, 420, 450}, {0, 899, 17, 464}, all, {899}};
  for (const int columns : {1, 7, 2, 1, 3}) {
    for (const std::vector<int>& rows : parts) {
      for (const std::vector<int>& wanted : parts) {
        const Eigen::MatrixXd b = right_hand_sides(std::ssize(rows), columns);
        Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(a.rows(), columns), x(a.rows(), columns);
        for (std::size_t k = 0; k < rows.size(); ++k) whole.row(rows[k]) = b.row(k);
        cholesky.solve(whole, x);
        Eigen::MatrixXd part(std::ssize(wanted), columns), expected(std::ssize(wanted), columns);
        for (std::size_t k = 0; k < wanted.size(); ++k) expected.row(k) = x.row(wanted[k]);
        cholesky.solve_part(rows, b, wanted, part);
        EXPECT_LT(relative_difference(part, expected), 1e-13);
      }
    }
  }
  // Another matrix of the same pattern, and one of another.
  for (const Matrix& other : {grid_laplacian(30, 2, 0.7), grid_laplacian(20, 3, 0.7)}) {
    cholesky.factor(other);
    Eigen::VectorXd b = Eigen::VectorXd::Zero(other.rows()), x(other.rows()), part(1);
    b[3] = 2.0;
    cholesky.solve(b, x);
    cholesky.solve_part(std::vector{3}, Eigen::VectorXd::Constant(1, 2.0), std::vector{211}, part);
    EXPECT_NEAR(part[0], x[211], 1e-13 * x.norm());
  }
}

/// A load in some rows that follows from what another one does there.
TEST(SparseCholesky, GoesOnWithWhatFollowsFromAPart) {
  const std::vector<int> rows = {7, 3, 131};
  SparseCholesky cholesky;
  for (const Matrix& a : {grid_laplacian(30, 2, 0.1), grid_laplacian(12, 3, 0.1)}) {
    cholesky.factor(a);
    Eigen::VectorXd b = right_hand_sides(a.rows(), 1), x(a.rows());
    cholesky.solve(b, x);
    const Eigen::VectorXd begun = cholesky.begin(b);
    const Eigen::VectorXd part = cholesky.part(begun, rows);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(part[k], x[rows[k]], 1e-13 * x.norm());
    EXPECT_LT(relative_difference(cholesky.finish(begun), x), 1e-13);
    const Eigen::VectorXd follows = part.array().square();
    const Eigen::VectorXd found = cholesky.finish(begun, rows, follows);
    for (int k = 0; k < 3; ++k) b[rows[k]] += follows[k];
    cholesky.solve(b, x);
    EXPECT_LT(relative_difference(found, x), 1e-13);
    EXPECT_EQ(cholesky.part(begun, rows), part);
  }
}

TEST(SparseCholesky, ReadsTheLowerHalfOnly) {
  const Matrix a = grid_laplacian(8, 2, 1.0);
  const Matrix lower = a.triangularView<Eigen::Lower>();
  Matrix spoilt_above = a;
  for (int column = 0; column < spoilt_above.cols(); ++column)
    for (Matrix::InnerIterator entry(spoilt_above, column); entry; ++entry)
      if (entry.row() < entry.col()) entry.valueRef() = 1e9;
  const Eigen::VectorXd b = right_hand_sides(a.rows(), 1);
  for (const Matrix& given : {lower, spoilt_above}) {
    SparseCholesky cholesky;
    cholesky.factor(given);
    Eigen::VectorXd x(a.rows());
    cholesky.solve(b, x);
    EXPECT_LT(relative_difference(a * x, b), 1e-13);
  }
}

TEST(SparseCholesky, FactorsAgainWithTheSamePatternAndWithAnother) {
  SparseCholesky cholesky;
  for (const Matrix& a : {grid_laplacian(10, 2, 0.1), grid_laplacian(10, 2, 50.0),
                          grid_laplacian(10, 1, 0.1), grid_laplacian(7, 2, 0.1)}) {
    cholesky.factor(a);
    const Eigen::VectorXd b = right_hand_sides(a.rows(), 1);
    Eigen::VectorXd x(a.rows());
    cholesky.solve(b, x);
    EXPECT_LT(relative_difference(a * x, b), 1e-12);
  }
}

TEST(SparseCholesky, SaysWhichRowIsNotPositiveDefinite) {
  SparseCholesky cholesky;
  Matrix a = grid_laplacian(6, 1, 1.0);
  cholesky.factor(a);
  a.coeffRef(17, 17) = -1.0;
  try {
    cholesky.factor(a);
    FAIL() << "no exception";
  } catch (const NotPositiveDefinite& error) {
    EXPECT_EQ(error.row(), 17);
    EXPECT_STREQ(error.what(), "the matrix is not positive definite (row 17)");
  }
  a.coeffRef(17, 17) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(cholesky.factor(a), NotPositiveDefinite);

  a.coeffRef(17, 17) = 20.0;
  cholesky.factor(a);
  const Eigen::VectorXd b = right_hand_sides(a.rows(), 1);
  Eigen::VectorXd x(a.rows());
  cholesky.solve(b, x);
  EXPECT_LT(relative_difference(a * x, b), 1e-13);
}

/// Of a matrix so large that branches of its factor are gone through side by side.
TEST(SparseCholesky, GivesTheSameBitsOnOneThreadAndOnMore) {
  const Matrix a = grid_laplacian(90, 3, 0.01);
  const Eigen::MatrixXd b = right_hand_sides(a.rows(), 8);
  const int threads = omp_get_max_threads(), levels = omp_get_max_active_levels();
  std::vector<Eigen::MatrixXd> solutions;
  for (const int count : {1, 3, 4}) {
    omp_set_num_threads(count);
    SparseCholesky cholesky;
    cholesky.factor(a);
    Eigen::MatrixXd& x = solutions.emplace_back(b.rows(), b.cols() + 2);
    cholesky.solve(b, x.leftCols(b.cols()));
    cholesky.solve(b.col(0), x.col(b.cols()));
    x.col(b.cols() + 1) = cholesky.finish(cholesky.begin(b.col(0)));
    EXPECT_EQ(omp_get_max_threads(), count) << "the number of threads was not put back";
    EXPECT_EQ(omp_get_max_active_levels(), levels);
    EXPECT_EQ(x.col(b.cols() + 1), x.col(b.cols()));
    EXPECT_LT(relative_difference(x.col(b.cols()), x.col(0)), 1e-13);
    EXPECT_LT(relative_difference(a * x.col(b.cols()), b.col(0)), 1e-12);
    EXPECT_EQ(x, solutions.front());
  }
  omp_set_num_threads(threads);
}

}  // namespace
}  // namespace perifrac
