#include "core/operators/face_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::AnyLaw;

template <int D, int R>
Eigen::SparseMatrix<double> free_gradient(const Body<D>& body) {
  const auto family = body.family(0);
  return gradient_matrix(*family, family_moments(*family), MirrorCondition<D, R>(*family));
}

template <int D, int R>
void expect_load_of_the_face_alone(const std::array<int, D>& counts, double spacing) {
  const auto body = test::box_body<D>(counts, spacing);
  const auto gradient = free_gradient<D, R>(*body);
  const Points<D>& points = body->points();
  for (int face = 0; face < 2 * D; ++face) {
    const Face& plane = body->faces()[face];
    double area = 1.0;
    for (int a = 0; a < D; ++a) area *= a == plane.axis ? 1.0 : counts[a] * spacing;
    for (int r = 0; r < R; ++r) {
      const Eigen::VectorXd load = face_load<D, R>(*body, gradient, 0, face, r);
      EXPECT_NEAR(load.sum(), area, 1e-12 * area) << plane.name;
      for (Index i = 0; i < points.size(); ++i) {
        const double depth = std::abs(plane.coordinate - points.position[plane.axis][i]);
        if (depth > 2.0 * body->horizon()) {
          EXPECT_EQ(load[i], 0.0);
        }
      }
    }
  }
}

TEST(FaceLoad, AddsUpToTheFacesAreaNearIt) {
  expect_load_of_the_face_alone<2, 1>({13, 11}, 0.5);
  expect_load_of_the_face_alone<2, 2>({11, 12}, 0.5);
  expect_load_of_the_face_alone<3, 1>({10, 11, 10}, 0.5);
  expect_load_of_the_face_alone<3, 3>({10, 10, 11}, 0.5);
}

/// Tractions on all faces of a body under uniform stress hold the inner forces, surfaces, edges and
/// corners included.
template <int D, int R>
void expect_balance(const std::array<int, D>& counts) {
  const double spacing = 0.5;
  const auto body = test::box_body<D>(counts, spacing);
  const auto family = body->family(0);
  LinearExactOperator<D, AnyLaw<R, D>> op(family, MirrorCondition<D, R>(*family), {});
  const auto gradient = op.gradient_matrix();
  const Index points = body->points().size();
  Tensor<R, D> slope;
  for (int k = 0; k < R * D; ++k) slope[k] = 0.3 * k - 0.8;
  const Tensor<R, D> stress = AnyLaw<R, D>{}.stress(slope);
  std::vector<double> u(op.size(), 0.0), force(op.size());
  Eigen::VectorXd load = Eigen::VectorXd::Zero(op.size());
  for (int r = 0; r < R; ++r) {
    for (int b = 0; b < D; ++b) {
      for (Index i = 0; i < points; ++i) {
        u[r * points + i] += slope[r * D + b] * body->points().position[b][i];
      }
      for (int face : {2 * b, 2 * b + 1}) {
        load.segment(r * points, points) += body->faces()[face].direction * stress[r * D + b] *
                                            face_load<D, R>(*body, gradient, 0, face, r);
      }
    }
  }
  op.apply(u, force);
  EXPECT_LT(test::largest(test::as_eigen(force) - load), 1e-12 * test::largest(load));
}

TEST(FaceLoad, BalancesUniformStress) {
  expect_balance<2, 1>({12, 14});
  expect_balance<2, 2>({13, 12});
  expect_balance<3, 3>({10, 11, 10});
}

/// The load of the top face where the bottom is mirrored evenly, which cuts the stress off there.
double load_above_a_sealed_face(int count) {
  const auto body = test::box_body<2>({8, count}, 1.0);
  const FaceSet mirrored = 0b0111;
  const auto family = body->family(mirrored);
  const auto gradient =
      gradient_matrix(*family, family_moments(*family), MirrorCondition<2, 1>(*family));
  return face_load<2, 1>(*body, gradient, mirrored, 3, 0).sum();
}

TEST(FaceLoad, RefusesABodyThatIsTooThin) {
  const auto body = test::box_body<2>({20, 9}, 1.0);
  const auto gradient = free_gradient<2, 2>(*body);
  EXPECT_NO_THROW((face_load<2, 2>(*body, gradient, 0, 0, 0)));
  try {
    face_load<2, 2>(*body, gradient, 0, 3, 1);
    FAIL() << "accepted";
  } catch (const BodyError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("9 m between faces 'top' and 'bottom'"));
    EXPECT_THAT(error.expected(), testing::HasSubstr("4 horizons, 10 m"));
  }
  EXPECT_NEAR(load_above_a_sealed_face(8), 8.0, 1e-12);
  EXPECT_THROW(load_above_a_sealed_face(7), BodyError);
}

}  // namespace
}  // namespace perifrac
