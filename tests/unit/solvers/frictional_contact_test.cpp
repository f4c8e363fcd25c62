#include "core/solvers/frictional_contact.hpp"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/solvers/complementarity.hpp"
#include "tests/unit/solvers/random_matrix.hpp"

namespace perifrac {
namespace {

/// Positive definite; `coupling` of the normal and tangential components of a pair with others.
Eigen::MatrixXd compliance(int pairs, double coupling, unsigned seed) {
  const Eigen::MatrixXd root = test::random_matrix(2 * pairs, 2 * pairs, seed);
  return Eigen::MatrixXd::Identity(2 * pairs, 2 * pairs) +
         coupling / pairs * root * root.transpose();
}

FrictionalContact solve_frictional_contact(const Eigen::MatrixXd& m, const Eigen::VectorXd& q,
                                           double coefficient, double rounding,
                                           std::span<const PairState> guess = {}) {
  FrictionalContactSolver solver;
  solver.take(m);
  return solver.solve(q, coefficient, rounding, guess);
}

/// What it is by definition, in random problems where openings and slips call for each other.
TEST(FrictionalContact, KeepsSignorinisAndCoulombsConditions) {
  int open = 0, stuck = 0, sliding = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    const int n = 1 + static_cast<int>(seed % 30);
    const double coefficient = 0.3 * static_cast<double>(seed % 5);
    const Eigen::MatrixXd m = compliance(n, 2.0, seed);
    const Eigen::VectorXd q = test::random_matrix(2 * n, 1, seed + 1000);
    const auto [x, y] = solve_frictional_contact(m, q, coefficient, 1e-14);
    EXPECT_LE((q + m * x - y).cwiseAbs().maxCoeff(), 1e-12 * (1.0 + x.cwiseAbs().maxCoeff()));
    for (int i = 0; i < n; ++i) {
      EXPECT_GE(x[i], 0.0) << seed;
      EXPECT_GE(y[i], -1e-14) << seed;
      EXPECT_EQ(x[i] == 0.0 || y[i] == 0.0, true) << seed;
      const double limit = coefficient * x[i], shear = x[n + i], slip = y[n + i];
      EXPECT_LE(std::abs(shear), (1.0 + 1e-8) * limit) << seed;
      EXPECT_LE(shear * slip, 0.0) << seed;
      if (slip != 0.0) {
        EXPECT_NEAR(std::abs(shear), limit, 1e-13 * limit) << seed;
      }
      (x[i] == 0.0 ? open : slip == 0.0 ? stuck : sliding) += 1;
    }
  }
  for (const int count : {open, stuck, sliding}) EXPECT_GT(count, 400);
}

/// Of many pairs most of which stick, and a change that is told apart: by the factor of the base,
/// and by that of the places that are held where more of them are open.
TEST(FrictionalContact, KnowsAChangeOfFewColumns) {
  const int n = 60;
  int open = 0, sliding = 0;
  for (unsigned seed = 0; seed < 40; ++seed) {
    LowRankChange change{.basis = test::random_matrix(2 * n, 3, seed),
                         .of_basis = 0.01 * Eigen::MatrixXd::Identity(3, 3)};
    change.left = 0.01 * test::random_matrix(2 * n, 1, seed + 1);
    change.right.resize(2 * n, 4);
    change.right << change.basis, change.left;
    Eigen::MatrixXd left(2 * n, 4);
    left << change.basis * change.of_basis, change.left;
    const Eigen::MatrixXd base = compliance(n, 0.2, seed);
    Eigen::VectorXd q = test::random_matrix(2 * n, 1, seed + 1000);
    q.head(n).array() -= seed % 2 == 0 ? 2.5 : 0.0;
    q.segment(n, n) *= 0.2;
    q[3] += 4.0;     // open
    q[n + 5] = 5.0;  // slides
    FrictionalContactSolver solver;
    solver.take(base);
    solver.change(change);
    const auto [x, y] = solver.solve(q, 0.6, 1e-14);
    const auto [x_whole, y_whole] =
        solve_frictional_contact(base + left * change.right.transpose(), q, 0.6, 1e-14);
    EXPECT_LE((x - x_whole).cwiseAbs().maxCoeff(), 1e-12) << seed;
    EXPECT_LE((y - y_whole).cwiseAbs().maxCoeff(), 1e-12) << seed;
    const Eigen::VectorXd m_x = base * x + left * (change.right.transpose() * x);
    EXPECT_LE((q + m_x - y).cwiseAbs().maxCoeff(), 1e-12) << seed;
    for (int i = 0; i < n; ++i) {
      EXPECT_TRUE(x[i] >= 0.0 && y[i] >= -1e-14 && (x[i] == 0.0 || y[i] == 0.0)) << seed;
      EXPECT_LE(std::abs(x[n + i]), (1.0 + 1e-8) * 0.6 * x[i]) << seed;
      EXPECT_LE(x[n + i] * y[n + i], 0.0) << seed;
      if (seed % 2 > 0) continue;
      if (x[i] == 0.0) ++open;
      if (x[i] > 0.0 && y[n + i] != 0.0) ++sliding;
    }
    // The next change has the same basis.
    change.of_basis *= 0.5;
    left << change.basis * change.of_basis, change.left;
    solver.change(change);
    const FrictionalContact next = solver.solve(q, 0.6, 1e-14);
    const FrictionalContact next_whole =
        solve_frictional_contact(base + left * change.right.transpose(), q, 0.6, 1e-14);
    EXPECT_LE((next.traction - next_whole.traction).cwiseAbs().maxCoeff(), 1e-12) << seed;
  }
  EXPECT_GE(open, 20);
  EXPECT_GE(sliding, 20);
  EXPECT_LE(open + sliding, 20 * n / 10);  // so few that the base's factor is the cheaper one
}

TEST(FrictionalContact, DoesNotDependOnWhereItBegins) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    const int n = 20;
    const Eigen::MatrixXd m = compliance(n, 2.0, seed);
    const Eigen::VectorXd q = test::random_matrix(2 * n, 1, seed + 1000);
    const Eigen::VectorXd chance = test::random_matrix(n, 1, seed + 2000);
    std::vector<PairState> guess;
    for (const double c : chance) {
      guess.push_back(c < -0.5  ? PairState::open
                      : c < 0.0 ? PairState::stick
                      : c < 0.5 ? PairState::forward
                                : PairState::backward);
    }
    const FrictionalContact from_none = solve_frictional_contact(m, q, 0.3, 1e-14);
    const FrictionalContact from_there = solve_frictional_contact(m, q, 0.3, 1e-14, guess);
    EXPECT_EQ(from_there.traction, from_none.traction) << seed;
    EXPECT_EQ(from_there.jump, from_none.jump) << seed;
  }
}

TEST(FrictionalContact, IsContactWithoutFriction) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const int n = 15;
    const Eigen::MatrixXd m = compliance(n, 2.0, seed);
    const Eigen::VectorXd q = test::random_matrix(2 * n, 1, seed + 1000);
    const auto [x, y] = solve_frictional_contact(m, q, 0.0, 1e-14);
    const Complementarity smooth = solve_complementarity(m.topLeftCorner(n, n), q.head(n), 1e-14);
    EXPECT_LE((x.head(n) - smooth.x).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LE((y.head(n) - smooth.y).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_EQ(x.tail(n).cwiseAbs().maxCoeff(), 0.0);
  }
}

TEST(FrictionalContact, SaysWhereItFindsNone) {
  const Eigen::Vector2d q(-1.0, std::nan(""));
  EXPECT_THROW(solve_frictional_contact(Eigen::Matrix2d::Identity(), q, 0.5, 1e-14),
               std::runtime_error);
}

}  // namespace
}  // namespace perifrac
