#include "coupling/acceleration.hpp"

#include <array>
#include <cmath>

#include <Eigen/Dense>
#include <gtest/gtest.h>

namespace perifrac {
namespace {

/// answer(y) = matrix y + offset, with the eigenvalues given and no symmetry.
struct LinearProblem {
  explicit LinearProblem(const Eigen::VectorXd& eigenvalues) {
    const Eigen::Index n = eigenvalues.size();
    Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = i + 1; j < n; ++j) basis(i, j) = 0.3 / static_cast<double>(1 + i + j);
    }
    matrix = basis * eigenvalues.asDiagonal() * basis.inverse();
    offset = Eigen::VectorXd::LinSpaced(n, 1.0, 2.0);
    solution = (Eigen::MatrixXd::Identity(n, n) - matrix).partialPivLu().solve(offset);
  }

  /// Answers asked for until the residual has fallen by `tolerance`; 1000 if it never does.
  int solve(Acceleration& acceleration, double tolerance) const {
    acceleration.begin_window();
    const Eigen::VectorXd scale = Eigen::VectorXd::Ones(offset.size());
    Eigen::VectorXd y = Eigen::VectorXd::Zero(offset.size());
    for (int asked = 1; asked < 1000; ++asked) {
      const Eigen::VectorXd answer = matrix * y + offset;
      if ((answer - y).norm() <= tolerance * offset.norm()) {
        EXPECT_LT((y - solution).norm(), 1e3 * tolerance * solution.norm());
        return asked;
      }
      y = acceleration.next(y, answer, scale);
    }
    return 1000;
  }

  Eigen::MatrixXd matrix;
  Eigen::VectorXd offset;
  Eigen::VectorXd solution;
};

TEST(Acceleration, AndersonSolvesAnMDimensionalLinearProblemInMPlusOneSteps) {
  for (int m = 1; m <= anderson_depth; ++m) {
    // Plain iteration diverges: the eigenvalues reach beyond -1.
    const LinearProblem problem(Eigen::VectorXd::LinSpaced(m, -3.0, -0.5));
    const auto anderson = make_acceleration(AccelerationType::anderson);
    // m + 1 steps, and one more answer to see that they did it.
    EXPECT_LE(problem.solve(*anderson, 1e-9), m + 2) << m;
  }
}

TEST(Acceleration, AndersonWithstandsStepsThatDependOnEachOther) {
  // Two distinct eigenvalues among twelve: from the third step on the history says nothing new.
  Eigen::VectorXd eigenvalues = Eigen::VectorXd::Constant(12, 0.9);
  eigenvalues.tail(6).setConstant(-0.9);
  const LinearProblem problem(eigenvalues);
  const auto anderson = make_acceleration(AccelerationType::anderson);
  EXPECT_LE(problem.solve(*anderson, 1e-12), 6);
}

TEST(Acceleration, AndersonStaysWhereItConvergedThoughAllStepsAreNoise) {
  const LinearProblem problem(Eigen::VectorXd::LinSpaced(12, -0.02, 0.02));
  const auto anderson = make_acceleration(AccelerationType::anderson);
  anderson->reset();
  Eigen::VectorXd y = Eigen::VectorXd::Zero(12);
  for (int asked = 1; asked <= 60; ++asked) {
    Eigen::VectorXd answer = problem.matrix * y + problem.offset;
    for (Eigen::Index i = 0; i < 12; ++i) answer[i] += 1e-12 * std::sin(7.0 * asked + 3.0 * i);
    if (asked > 20) {
      ASSERT_LT((answer - y).norm(), 1e-10) << asked;
    }
    y = anderson->next(y, answer, Eigen::VectorXd::Ones(12));
  }
  EXPECT_LT((y - problem.solution).norm(), 1e-10);
}

TEST(Acceleration, QuasiNewtonKnowsTheWindowsBefore) {
  LinearProblem problem(Eigen::VectorXd::LinSpaced(5, -3.0, -0.5));
  const auto quasi_newton = make_acceleration(AccelerationType::quasi_newton);
  EXPECT_GE(problem.solve(*quasi_newton, 1e-9), 6);
  problem.offset *= -2.0;
  problem.offset[1] += 7.0;
  problem.solution =
      (Eigen::MatrixXd::Identity(5, 5) - problem.matrix).partialPivLu().solve(problem.offset);
  // One answer, which the steps of before lead on from, and another to see that they did.
  EXPECT_EQ(problem.solve(*quasi_newton, 1e-9), 2);
  quasi_newton->reset();
  EXPECT_GE(problem.solve(*quasi_newton, 1e-9), 6);
}

/// A crack that has grown by a facet: its first facets answer as before.
TEST(Acceleration, QuasiNewtonGoesOnWhereEntriesHaveCome) {
  const LinearProblem before(Eigen::VectorXd::LinSpaced(5, -3.0, -0.5));
  LinearProblem after(Eigen::VectorXd::LinSpaced(6, -3.0, -0.5));
  after.matrix.setZero();
  const std::array<Eigen::Index, 5> kept = {0, 1, 3, 4, 5};  // 2 is new
  for (Eigen::Index i = 0; i < 5; ++i) {
    for (Eigen::Index j = 0; j < 5; ++j) after.matrix(kept[i], kept[j]) = before.matrix(i, j);
  }
  after.matrix(2, 2) = -0.7;
  after.solution =
      (Eigen::MatrixXd::Identity(6, 6) - after.matrix).partialPivLu().solve(after.offset);
  const auto quasi_newton = make_acceleration(AccelerationType::quasi_newton);
  EXPECT_GE(before.solve(*quasi_newton, 1e-9), 6);
  quasi_newton->follow(kept, 6);
  EXPECT_LE(after.solve(*quasi_newton, 1e-9), 4);
}

TEST(Acceleration, AitkenIsExactForOneNumberAndTamesDivergence) {
  const auto aitken = make_acceleration(AccelerationType::aitken);
  EXPECT_LE(LinearProblem(Eigen::VectorXd::Constant(1, -4.0)).solve(*aitken, 1e-12), 4);
  EXPECT_LE(LinearProblem(Eigen::VectorXd::Constant(7, -1.5)).solve(*aitken, 1e-12), 4);
}

TEST(Acceleration, NoneTriesTheAnswer) {
  const LinearProblem problem(Eigen::VectorXd::Constant(2, 0.5));
  const auto none = make_acceleration(AccelerationType::none);
  // Each pass halves the residual: 2^-30 < 1e-9 < 2^-29.
  EXPECT_EQ(problem.solve(*none, 1e-9), 31);
}

TEST(Acceleration, AFixedPointStaysPut) {
  for (const auto type : {AccelerationType::none, AccelerationType::aitken,
                          AccelerationType::anderson, AccelerationType::quasi_newton}) {
    const auto acceleration = make_acceleration(type);
    acceleration->reset();
    const Eigen::VectorXd y = Eigen::VectorXd::Constant(3, 2.0);
    for (int i = 0; i < 4; ++i) EXPECT_EQ(acceleration->next(y, y, Eigen::VectorXd::Ones(3)), y);
  }
}

}  // namespace
}  // namespace perifrac
