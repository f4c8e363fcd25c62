#include "core/solvers/condensed_inverse.hpp"

#include <numeric>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "tests/unit/solvers/random_matrix.hpp"

namespace perifrac {
namespace {

constexpr int size = 30;

/// A matrix that is positive definite, its factor, and the inverse condensed from it.
struct Setting {
  explicit Setting(int unknowns, double least)
      : root(test::random_matrix(unknowns, unknowns, 1)),
        a(root * root.transpose() + least * Eigen::MatrixXd::Identity(unknowns, unknowns)),
        start(a.sparseView()) {
    factor.factor(start);
  }

  Eigen::MatrixXd root, a;  ///< a takes the changes
  Eigen::SparseMatrix<double> start;
  SparseCholesky factor;
  CondensedInverse inverse{factor, start.cols()};
};

/// After several additions and changes, in whatever order they come: against the dense inverse.
TEST(CondensedInverse, IsABlockOfTheInverseOfTheChangedMatrix) {
  Setting setting(size, 5.0);
  Eigen::MatrixXd& a = setting.a;
  CondensedInverse& inverse = setting.inverse;
  const Eigen::VectorXd b = test::random_matrix(size, 1, 2);
  const Eigen::VectorXd x0 = Eigen::MatrixXd(setting.start).llt().solve(b);

  const std::vector<std::vector<int>> steps = {{3, 17, 8}, {8, 0, 29}, {5}, {17, 5, 12, 3}};
  for (std::size_t step = 0; step < steps.size(); ++step) {
    inverse.add(steps[step]);
    const int count = static_cast<int>(steps[step].size());
    const Eigen::MatrixXd half = test::random_matrix(count, count, 10 + step);
    // A softer and a stiffer matrix in turn; positive definite either way.
    const Eigen::MatrixXd delta = (step % 2 == 0 ? -1.0 : 3.0) * half * half.transpose();
    std::vector<int> places;
    for (const int unknown : steps[step]) places.push_back(inverse.place(unknown));
    inverse.change(places, delta);
    for (int r = 0; r < count; ++r) {
      for (int c = 0; c < count; ++c) a(steps[step][r], steps[step][c]) += delta(r, c);
    }
    ASSERT_EQ(a.llt().info(), Eigen::Success);

    const Eigen::MatrixXd exact = a.inverse();
    const Eigen::VectorXd x = exact * b;
    const auto named = inverse.unknowns();
    Eigen::VectorXd part0(named.size()), part(named.size());
    for (std::size_t r = 0; r < named.size(); ++r) {
      EXPECT_EQ(inverse.place(named[r]), static_cast<int>(r));
      part0[r] = x0[named[r]];
      part[r] = x[named[r]];
      for (std::size_t c = 0; c < named.size(); ++c) {
        EXPECT_NEAR(inverse.block()(r, c), exact(named[r], named[c]), 1e-13);
      }
    }
    EXPECT_LE((inverse.correct_block(part0) - part).cwiseAbs().maxCoeff(), 1e-13);
    const Eigen::VectorXd force = inverse.force_of_changes(part);
    Eigen::VectorXd rest = Eigen::MatrixXd(setting.start) * x - b;
    for (std::size_t r = 0; r < named.size(); ++r) rest[named[r]] += force[r];
    EXPECT_LE(rest.cwiseAbs().maxCoeff(), 1e-12);
  }
  EXPECT_EQ(inverse.unknowns().size(), 7u);
  EXPECT_EQ(inverse.place(1), -1);
}

/// More than are found together, beside changes of what was there before.
TEST(CondensedInverse, AddsManyUnknownsAtOnce) {
  constexpr int many = 200;
  Setting setting(many, 50.0);
  Eigen::MatrixXd& a = setting.a;
  CondensedInverse& inverse = setting.inverse;
  inverse.add(std::vector<int>{7, 120});
  inverse.change(std::vector<int>{0, 1}, 9.0 * Eigen::MatrixXd::Identity(2, 2));
  for (const int unknown : {7, 120}) a(unknown, unknown) += 9.0;

  std::vector<int> rest(many - 20);
  std::iota(rest.begin(), rest.end(), 0);
  inverse.add(rest);
  ASSERT_EQ(inverse.unknowns().size(), rest.size());
  const Eigen::MatrixXd exact = a.inverse();
  for (const int r : rest) {
    for (const int c : rest) {
      ASSERT_NEAR(inverse.block()(inverse.place(r), inverse.place(c)), exact(r, c), 1e-14);
    }
  }
}

/// Sums and unknowns beside each other, which share some: rows of (A + changes)^-1 between them.
TEST(CondensedInverse, TakesSumsOfUnknowns) {
  Setting setting(size, 5.0);
  Eigen::MatrixXd& a = setting.a;
  CondensedInverse& inverse = setting.inverse;
  inverse.add(std::vector<UnknownSum>{{{3, 1.0}, {9, -2.0}}, {}, {{9, 0.5}, {9, 0.25}, {4, 1.0}}});
  inverse.add(std::vector<int>{9, 12});
  EXPECT_EQ(inverse.place(9), 3);
  EXPECT_EQ(inverse.place(3), -1);
  inverse.change(std::vector<int>{3, 4}, 2.0 * Eigen::MatrixXd::Identity(2, 2));
  for (const int unknown : {9, 12}) a(unknown, unknown) += 2.0;
  inverse.add(std::vector<UnknownSum>{{{12, 1.0}, {20, 1.0}}});

  Eigen::MatrixXd places = Eigen::MatrixXd::Zero(size, 6);
  places(3, 0) = 1.0;
  places(9, 0) = -2.0;
  places(9, 2) = 0.75;
  places(4, 2) = places(9, 3) = places(12, 4) = places(12, 5) = places(20, 5) = 1.0;
  const Eigen::MatrixXd exact = a.inverse();
  EXPECT_LE((inverse.block() - places.transpose() * exact * places).cwiseAbs().maxCoeff(), 1e-14);

  const auto named = inverse.unknowns();
  EXPECT_EQ(std::vector<int>(named.begin(), named.end()), (std::vector<int>{3, 9, 4, 12, 20}));
  const Eigen::VectorXd x = test::random_matrix(size, 1, 2), force = test::random_matrix(6, 1, 3);
  Eigen::VectorXd x_named(5), force_named(5);
  for (int k = 0; k < 5; ++k) {
    x_named[k] = x[named[k]];
    force_named[k] = (places * force)[named[k]];
  }
  EXPECT_LE((inverse.at_places(x_named) - places.transpose() * x).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LE((inverse.on_unknowns(force) - force_named).cwiseAbs().maxCoeff(), 1e-15);
}

/// What is taken away may be all that there is of an unknown.
TEST(CondensedInverse, SaysWhereNothingIsLeft) {
  const Eigen::SparseMatrix<double> start = Eigen::MatrixXd::Identity(size, size).sparseView();
  SparseCholesky factor;
  factor.factor(start);
  CondensedInverse inverse(factor, size);
  const std::vector<int> unknowns = {17};
  inverse.add(unknowns);
  inverse.change(std::vector<int>{0}, -Eigen::MatrixXd::Identity(1, 1) * (1.0 - 1e-2));
  EXPECT_NEAR(inverse.block()(0, 0), 1e2, 1e-9);
  try {
    inverse.change(std::vector<int>{0}, -Eigen::MatrixXd::Identity(1, 1) * 1e-2);
    FAIL() << "what is singular has an inverse";
  } catch (const NotPositiveDefinite& error) {
    EXPECT_EQ(error.row(), 17);
  }
  // And is as it was.
  EXPECT_NEAR(inverse.block()(0, 0), 1e2, 1e-9);
  EXPECT_NEAR(inverse.correct_block(Eigen::VectorXd::Ones(1))[0], 1e2, 1e-9);
}

}  // namespace
}  // namespace perifrac
