#include "core/solvers/smoothed_aggregation.hpp"

#include <algorithm>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

using Matrix = Eigen::SparseMatrix<double>;

/// A diffusion's matrix from what ties unknowns to each other.
Matrix diffusion(int size, const std::vector<Eigen::Triplet<double>>& ties) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < size; ++i) entries.emplace_back(i, i, 0.0);
  for (const auto& tie : ties) {
    const int i = tie.row(), j = tie.col();
    entries.emplace_back(i, j, -tie.value());
    entries.emplace_back(j, i, -tie.value());
    entries.emplace_back(i, i, tie.value());
    entries.emplace_back(j, j, tie.value());
  }
  Matrix matrix(size, size);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

/// A chain of unknowns, each tied to the next two; `weak`: the tie across its middle.
std::vector<Eigen::Triplet<double>> chain(int size, double weak = 1.0) {
  std::vector<Eigen::Triplet<double>> ties;
  for (int i = 0; i < size; ++i) {
    for (int j = i + 1; j < std::min(i + 3, size); ++j) {
      ties.emplace_back(i, j, i < size / 2 && j >= size / 2 ? weak : 1.0);
    }
  }
  return ties;
}

TEST(SmoothedAggregation, KeepsWhatIsTheSameEverywhere) {
  const int size = 400;
  const auto levels = aggregate(diffusion(size, chain(size)), std::vector<bool>(size, false), 10);
  ASSERT_GE(levels.size(), 3u);
  for (const AggregatedMatrix& level : levels) {
    const Eigen::VectorXd ones = Eigen::VectorXd::Ones(level.matrix.cols());
    EXPECT_LT((level.matrix * ones).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_LT((level.matrix - Matrix(level.matrix.transpose())).norm(), 1e-12);
    if (level.from_coarser.size() == 0) continue;
    const Eigen::VectorXd fine =
        level.from_coarser * Eigen::VectorXd::Ones(level.from_coarser.cols());
    EXPECT_LT((fine - ones).lpNorm<Eigen::Infinity>(), 1e-12);
    EXPECT_GE(level.from_coarser.coeffs().minCoeff(), 0.0);
  }
  EXPECT_LE(levels.back().matrix.cols(), 10);
}

/// As a diffusion's own: fast where it is strong, and parted where next to nothing ties.
TEST(SmoothedAggregation, GathersNothingAcrossWeakTies) {
  const int size = 60;
  const auto levels =
      aggregate(diffusion(size, chain(size, 1e-6)), std::vector<bool>(size, false), 20);
  const Eigen::MatrixXd way = levels.front().from_coarser;
  for (int k = 0; k < way.cols(); ++k) {
    const bool is_left = way.col(k).head(size / 2).any(),
               is_right = way.col(k).tail(size / 2).any();
    EXPECT_NE(is_left, is_right) << k;
  }
}

TEST(SmoothedAggregation, LeavesOutWhatIsHeldOrAlone) {
  const int size = 62;  // the last two: nothing ties them
  std::vector<bool> held(size, false);
  held[0] = held[31] = true;
  const auto levels = aggregate(diffusion(size, chain(size - 2)), held, 20);
  const Eigen::VectorXd fine =
      levels.front().from_coarser * Eigen::VectorXd::Ones(levels.front().from_coarser.cols());
  for (const int out : {0, 31, 60, 61}) EXPECT_EQ(fine[out], 0.0) << out;
  // Beside what is held a quarter or more leads there.
  EXPECT_LT(fine[1], 1.0);
  EXPECT_NEAR(fine[15], 1.0, 1e-12);
  for (Eigen::Index k = 0; k < levels[1].matrix.cols(); ++k) {
    EXPECT_GT(levels[1].matrix.coeff(k, k), 0.0);
  }
}

TEST(SmoothedAggregation, EndsWhereNothingIsTied) {
  const auto levels = aggregate(diffusion(50, {}), std::vector<bool>(50, false), 10);
  EXPECT_EQ(levels.size(), 1u);
}

}  // namespace
}  // namespace perifrac
