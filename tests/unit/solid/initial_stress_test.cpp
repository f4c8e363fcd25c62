#include <gtest/gtest.h>

#include "core/operators/face_load.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac {
namespace {

using test::Cloud;

template <int D>
using Make = std::shared_ptr<ElasticOperator<D>> (*)(const Body<D>&, const SolidBoundary<D>&,
                                                     IsotropicElasticity<D>,
                                                     std::optional<Vector<D>>);

template <int D>
constexpr std::array<Make<D>, 2> materials = {test::elastic<D>, test::lps<D>};

template <int D>
Vector<D> initial_stress() {
  Vector<D> stress;
  for (int a = 0; a < D; ++a) stress[a] = -1.5 - 0.7 * a;
  return stress;
}

template <int D>
double area_of(const Body<D>& body, int face) {
  double area = 1.0;
  for (int a = 0; a < D; ++a) {
    if (a != face / 2) area *= body.faces()[2 * a + 1].coordinate;
  }
  return area;
}

/// Inside, at edges and at corners the initial force is the load of the tractions on the free
/// faces, and at the others the reaction of the stress behind them.
template <int D>
void expect_tractions_of_the_faces(int count) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.5);
  SolidBoundary<D> boundary(*body);
  boundary.roller(0, 0.0);
  boundary.rigid_plate(2 * D - 1, 0.0);
  const FaceSet mirrored = boundary.mirrored();
  const auto mirror = boundary.mirror_condition(*body->family(mirrored));
  const Index points = body->points().size();
  const Vector<D> stress = initial_stress<D>();
  for (const auto make : materials<D>) {
    const auto solid = make(*body, boundary, {3.0, 2.0}, stress);
    const ForceOfStress force_of = test::force_of(*solid);
    Eigen::VectorXd expected = Eigen::VectorXd::Zero(solid->size());
    for (int face = 0; face < 2 * D; ++face) {
      const int axis = face / 2;
      const double traction = body->faces()[face].direction * stress[axis];
      if (contains(mirrored, face)) {
        expected[D * points + mirror.face_value(face, axis)] = traction * area_of(*body, face);
      } else {
        expected.segment(axis * points, points) +=
            traction * face_load<D, D>(*body, force_of, mirrored, face, axis);
      }
    }
    const double scale = test::largest(expected);
    EXPECT_LT(test::largest(test::as_eigen(solid->initial_force()) - expected), 1e-12 * scale);
  }
}

TEST(InitialStress, IsBorneByWhatLiesBehindTheFaces) {
  expect_tractions_of_the_faces<2>(12);
  expect_tractions_of_the_faces<3>(10);
}

/// The force of the initial stress is the transpose of the gradient, on any cloud, beside fixed
/// faces too, and adds to the stress and to nothing else.
template <int D>
void expect_no_more_than_a_constant(int count) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.5, Cloud::jittered);
  SolidBoundary<D> boundary(*body);
  boundary.fixed(1, {});
  boundary.roller(2 * D - 2, 0.0);
  const Index points = body->points().size();
  const Vector<D> stress = initial_stress<D>();
  for (const auto make : materials<D>) {
    const auto loaded = make(*body, boundary, {3.0, 2.0}, stress);
    const auto plain = make(*body, boundary, {3.0, 2.0}, {});
    const std::vector<double> u = test::random_values(loaded->size());
    const std::vector<double> pore = test::random_values(points, 4), slope(points, 0.3);
    std::vector<double> force(u.size()), without(u.size()), theta(points);
    Eigen::VectorXd flux = Eigen::VectorXd::Zero(D * D * points);
    for (int a = 0; a < D; ++a) {
      for (Index i = 0; i < points; ++i) {
        flux[(a * D + a) * points + i] = stress[a] * body->points().volume[i];
      }
    }
    const Eigen::VectorXd initial = loaded->force_of_stress(flux);
    for (const PoreStress& pores : {PoreStress{}, PoreStress{pore, {}}, PoreStress{pore, slope}}) {
      loaded->apply(u, pores, force, theta);
      plain->apply(u, pores, without, theta);
      EXPECT_LT(test::largest(test::as_eigen(force) - test::as_eigen(without) - initial),
                1e-12 * test::largest(force));
    }
    std::vector<double> total(D * D * points), elastic(D * D * points);
    loaded->stress(u, total);
    plain->stress(u, elastic);
    for (int k = 0; k < D * D; ++k) {
      for (Index i = 0; i < points; ++i) {
        const double expected = k % (D + 1) == 0 ? stress[k / D] : 0.0;
        ASSERT_NEAR(total[k * points + i] - elastic[k * points + i], expected,
                    1e-13 * test::largest(total));
      }
    }
  }
}

TEST(InitialStress, AddsAConstantForceAndStress) {
  expect_no_more_than_a_constant<2>(8);
  expect_no_more_than_a_constant<3>(5);
}

}  // namespace
}  // namespace perifrac
