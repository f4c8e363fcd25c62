#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/operators/face_load.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::AnyLaw;

template <int D, int R>
LinearExactOperator<D, AnyLaw<R, D>> held_at_the_right(std::shared_ptr<const Family<D>> family) {
  MirrorCondition<D, R> mirror(*family);
  for (int r = 0; r < R; ++r) mirror.set_odd(1, r);
  return {family, mirror, AnyLaw<R, D>{}};
}

/// A layer without bonds might as well not be there: operators, matrices and gradients are those of
/// the body without it, and its own rows are zero whatever its values.
template <int D, int R>
void expect_the_operator_of_the_body_proper(const std::array<int, D>& counts) {
  const FaceSet mirrored = 0b0110, layered = 0b0001;
  const auto with = test::layered_body<D>(counts, 0.5, layered);
  const auto without = test::box_body<D>(counts, 0.5);
  auto op = held_at_the_right<D, R>(with->family(mirrored, layered));
  auto reference = held_at_the_right<D, R>(without->family(mirrored));
  const Index all = with->points().size(), proper = without->points().size();

  std::map<Vector<D>, Index> numbers;
  for (Index i = 0; i < proper; ++i) numbers[without->points().at(i)] = i;
  const std::vector<double> u = test::random_values(reference.size());
  std::vector<double> layered_u = test::random_values(op.size(), 2);
  std::vector<Index> number(all, -1);
  for (Index i = 0; i < all; ++i) {
    const auto found = numbers.find(with->points().at(i));
    if (found == numbers.end()) continue;
    number[i] = found->second;
    for (int r = 0; r < R; ++r) layered_u[r * all + i] = u[r * proper + number[i]];
  }
  std::copy_n(u.end() - R, R, layered_u.end() - R);

  const auto compare = [&](const auto& found, const auto& expected, int blocks) {
    const double scale = test::largest(expected);
    for (Index i = 0; i < all; ++i) {
      for (int k = 0; k < blocks; ++k) {
        if (number[i] < 0) {
          ASSERT_EQ(found[k * all + i], 0.0);
        } else {
          ASSERT_NEAR(found[k * all + i], expected[k * proper + number[i]], 1e-13 * scale);
        }
      }
    }
    for (Index k = 0; k < static_cast<Index>(expected.size()) - blocks * proper; ++k) {
      ASSERT_NEAR(found[blocks * all + k], expected[blocks * proper + k], 1e-13 * scale);
    }
  };
  std::vector<double> force(reference.size()), layered_force(op.size());
  reference.apply(u, force);
  op.apply(layered_u, layered_force);
  compare(layered_force, force, R);
  const Eigen::SparseMatrix<double> matrix = op.assemble();
  compare(Eigen::VectorXd(matrix * test::as_eigen(layered_u)),
          Eigen::VectorXd(reference.assemble() * test::as_eigen(u)), R);
  std::vector<double> gradient(R * D * proper), layered_gradient(R * D * all);
  reference.gradient(u, gradient);
  op.gradient(layered_u, layered_gradient);
  compare(layered_gradient, gradient, R * D);

  // A storage is added on the diagonal without a new entry.
  for (Index k = 0; k < matrix.cols(); ++k) {
    bool stored = false;
    for (Eigen::SparseMatrix<double>::InnerIterator entry(matrix, k); entry; ++entry) {
      stored = stored || entry.row() == k;
      ASSERT_TRUE(std::isfinite(entry.value()));
    }
    ASSERT_TRUE(stored) << k;
  }
}

TEST(BondlessPoints, LeaveTheOperatorOfTheBodyProper) {
  expect_the_operator_of_the_body_proper<2, 1>({7, 6});
  expect_the_operator_of_the_body_proper<2, 2>({7, 6});
  expect_the_operator_of_the_body_proper<3, 1>({5, 4, 4});
  expect_the_operator_of_the_body_proper<3, 3>({5, 4, 4});
}

// What is added to their stress has nothing to act on.
TEST(BondlessPoints, FeelNoStress) {
  const auto body = test::layered_body<2>({6, 6}, 0.5, 0b0001);
  auto op = held_at_the_right<2, 2>(body->family(0b0110, 0b0001));
  const std::vector<double> u = test::random_values(op.size());
  std::vector<double> force(op.size());
  op.apply(u, force, [](Index, const Tensor<2, 2>&, Tensor<2, 2>& stress) { stress[0] -= 3.0; });
  for (const Index i : body->layer(0)) EXPECT_EQ(force[i], 0.0);
  for (const double f : force) EXPECT_TRUE(std::isfinite(f));
}

TEST(BondlessPoints, DoNotExcuseAFlatFamily) {
  const auto body = test::layered_body<2>({8, 1}, 1.0, 0b1000);
  EXPECT_NO_THROW(family_moments(*body->family(0)));
  EXPECT_THROW(family_moments(*body->family(0, 0b1000)), BodyError);
}

double load_above_a_layer(int count, FaceSet without_layers) {
  const auto body = test::layered_body<2>({8, count}, 1.0, 0b0100);
  const auto family = body->family(0, without_layers);
  const ForceOfStress force_of = test::force_by(
      gradient_matrix(*family, family_moments(*family), MirrorCondition<2, 1>(*family)));
  return face_load<2, 1>(*body, force_of, 0, 3, 0, without_layers).sum();
}

// Four horizons of 2.5 spacings: the layer's three rows count where they have bonds.
TEST(BondlessPoints, AddNothingToTheThicknessUnderAFaceLoad) {
  EXPECT_NEAR(load_above_a_layer(7, 0), 8.0, 1e-12);
  EXPECT_THROW(load_above_a_layer(6, 0), BodyError);
  EXPECT_NEAR(load_above_a_layer(10, 0b0100), 8.0, 1e-12);
  EXPECT_THROW(load_above_a_layer(9, 0b0100), BodyError);
}

// Beside a layer with bonds the load goes on, so that uniform stress stays in balance.
TEST(FaceLoadBesideALayer, GoesOnAlongTheLayer) {
  const auto body = test::layered_body<2>({11, 9}, 1.0, 0b1000);
  const auto family = body->family(0);
  LinearExactOperator<2, AnyLaw<2, 2>> op(family, MirrorCondition<2, 2>(*family), {});
  EXPECT_NEAR((face_load<2, 2>(*body, test::force_of(op), 0, 0, 1).sum()), 12.0, 1e-12);
}

}  // namespace
}  // namespace perifrac
