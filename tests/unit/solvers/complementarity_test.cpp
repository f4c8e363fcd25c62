#include "core/solvers/complementarity.hpp"

#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/solvers/random_matrix.hpp"

namespace perifrac {
namespace {

/// What it is by definition, for matrices of all kinds of coupling: among them some for which
/// exchanging all wrong places at once goes in circles.
TEST(Complementarity, HoldsWhatWouldFallBelowZero) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int n = 1 + static_cast<int>(seed % 40);
    const Eigen::MatrixXd root = test::random_matrix(n, n, seed);
    // Positive definite, not symmetric: facets differ in length.
    const Eigen::MatrixXd m =
        (root * root.transpose() + 1e-3 * Eigen::MatrixXd::Identity(n, n)) *
        (test::random_matrix(n, 1, seed + 1000).array() + 1.5).matrix().asDiagonal();
    const Eigen::VectorXd q = test::random_matrix(n, 1, seed + 2000);
    const Complementarity found = solve_complementarity(m, q, 1e-12);
    EXPECT_GE(found.x.minCoeff(), 0.0) << seed;
    EXPECT_GE(found.y.minCoeff(), -1e-12) << seed;
    EXPECT_EQ(found.x.cwiseAbs().cwiseProduct(found.y.cwiseAbs()).sum(), 0.0) << seed;
    const double size = 1.0 + found.x.maxCoeff();
    EXPECT_LE((q + m * found.x - found.y).cwiseAbs().maxCoeff(), 1e-11 * size) << seed;
  }
}

/// One problem after the other, from what the last one held or from places at random, some of which
/// do not answer at all: the answers of each alone, to the last bit.
TEST(Complementarity, DoesNotDependOnWhereItBegins) {
  ComplementaritySolver solver;
  const int n = 30;
  for (unsigned seed = 0; seed < 60; ++seed) {
    const Eigen::MatrixXd root = test::random_matrix(n, n, seed / 5);
    Eigen::MatrixXd m = root * root.transpose() + 0.1 * Eigen::MatrixXd::Identity(n, n);
    m.row(3).setZero();
    m.col(3).setZero();
    const Eigen::VectorXd q = test::random_matrix(n, 1, seed + 2000);
    if (seed % 3 == 0) {
      const Eigen::VectorXd guess = test::random_matrix(n, 1, seed + 3000);
      std::vector<bool> held;
      for (const double g : guess) held.push_back(g > 0.0);
      solver.begin_from(held);
    }
    const Complementarity alone = solve_complementarity(m, q, 1e-12);
    const Complementarity found = solver.solve(m, q, 1e-12);
    EXPECT_EQ(found.held, alone.held) << seed;
    EXPECT_EQ(found.x, alone.x) << seed;
    EXPECT_EQ(found.y, alone.y) << seed;
  }
}

TEST(Complementarity, LeavesAloneWhatIsOpen) {
  const Complementarity found =
      solve_complementarity(Eigen::MatrixXd::Identity(2, 2), Eigen::Vector2d(0.0, 3.0), 0.0);
  EXPECT_EQ(found.y, Eigen::Vector2d(0.0, 3.0));
  EXPECT_EQ(found.x, Eigen::Vector2d::Zero());
}

/// The response is the slope of the solution, by differences.
TEST(Complementarity, RespondsWithThePlacesHeld) {
  const int n = 12;
  const Eigen::MatrixXd root = test::random_matrix(n, n, 7);
  const Eigen::MatrixXd m = root * root.transpose() + Eigen::MatrixXd::Identity(n, n);
  const Eigen::VectorXd q = test::random_matrix(n, 1, 8);
  ComplementaritySolver solver;
  const Complementarity found = solver.solve(m, q, 0.0);
  const Eigen::MatrixXd slope = solver.response(m, m);
  const double step = 1e-6;
  for (int j = 0; j < n; ++j) {
    const Eigen::VectorXd moved = q + step * m.col(j);
    const Complementarity next = solve_complementarity(m, moved, 0.0);
    ASSERT_EQ(next.held, found.held);
    EXPECT_LE((next.y - found.y - step * slope.col(j)).cwiseAbs().maxCoeff(), 1e-12) << j;
  }
}

}  // namespace
}  // namespace perifrac
