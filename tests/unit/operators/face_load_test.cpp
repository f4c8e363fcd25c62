#include "core/operators/face_load.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/geometry/lattice.hpp"
#include "core/operators/linear_exact.hpp"
#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::AnyLaw;

template <int D, int R>
ForceOfStress free_force(const Body<D>& body) {
  const auto family = body.family(0);
  return test::force_by(
      gradient_matrix(*family, family_moments(*family), MirrorCondition<D, R>(*family)));
}

template <int D, int R>
void expect_load_of_the_face_alone(const std::array<int, D>& counts, double spacing) {
  const auto body = test::box_body<D>(counts, spacing);
  const ForceOfStress force_of = free_force<D, R>(*body);
  const Points<D>& points = body->points();
  for (int face = 0; face < 2 * D; ++face) {
    const Face& plane = body->faces()[face];
    double area = 1.0;
    for (int a = 0; a < D; ++a) area *= a == plane.axis ? 1.0 : counts[a] * spacing;
    for (int r = 0; r < R; ++r) {
      const Eigen::VectorXd load = face_load<D, R>(*body, force_of, 0, face, r);
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
  const ForceOfStress force_of = test::force_of(op);
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
                                            face_load<D, R>(*body, force_of, 0, face, r);
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

/// A box of 30 x 26 points, a metre apart, less what is cut out.
std::shared_ptr<Body<2>> cut_body(const Region<2>& box) {
  const Points<2> lattice = box_lattice<2>({30, 26}, 1.0);
  Points<2> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    if (!box.contains(lattice.at(i))) points.add(lattice.at(i), 1.0);
  }
  const auto whole = test::box_body<2>({30, 26}, 1.0);
  auto body = std::make_shared<Body<2>>(std::move(points), whole->faces(), 1.0, whole->horizon(),
                                        InfluenceFunction::gaussian);
  body->set_cutouts({box});
  return body;
}

/// Loads on faces and walls of a hole balance uniform stress.
TEST(CutoutLoad, BalancesUniformStressWithTheFaces) {
  const auto body = cut_body({"hole", {12.0, 11.0}, {17.0, 14.0}});
  const ForceOfStress force_of = free_force<2, 2>(*body);
  const Index points = body->points().size();
  for (int axis = 0; axis < 2; ++axis) {
    Eigen::VectorXd stress = Eigen::VectorXd::Zero(4 * points);
    stress.segment(3 * axis * points, points).setOnes();
    const Eigen::VectorXd all = force_of(stress);
    const Eigen::VectorXd walls = cutout_load<2>(*body, force_of, axis);
    Eigen::VectorXd sum = walls;
    for (const int side : {-1, 1}) {
      sum += side * face_load<2, 2>(*body, force_of, 0, 2 * axis + (side > 0 ? 1 : 0), axis);
    }
    EXPECT_LT(test::largest(sum - all.segment(axis * points, points)), 1e-12);
    EXPECT_NEAR(walls.sum(), 0.0, 1e-12);
  }
}

/// A round one off the middle of the lattice, under a stress that differs by axis.
TEST(CurvedLoad, BalancesUniformStressWithTheFaces) {
  const Face hole{
      .name = "hole", .axis = -1, .direction = -1, .coordinate = 2.8, .centre = {15.2, 12.9}};
  const Points<2> lattice = box_lattice<2>({30, 26}, 1.0);
  Points<2> points;
  for (Index i = 0; i < lattice.size(); ++i) {
    if (hole.depth(lattice.at(i)) > 0.0) points.add(lattice.at(i), 1.0);
  }
  const auto whole = test::box_body<2>({30, 26}, 1.0);
  std::vector<Face> faces = whole->faces();
  faces.push_back(hole);
  const Body<2> body(std::move(points), faces, 1.0, whole->horizon(), InfluenceFunction::gaussian);
  const ForceOfStress force_of = free_force<2, 2>(body);
  const Index count = body.points().size();
  const Vector<2> principal = {-1.3, 0.4};
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(4 * count);
  for (int a = 0; a < 2; ++a) stress.segment(3 * a * count, count).setConstant(principal[a]);
  Eigen::VectorXd sum = curved_load<2>(body, force_of, 0, hole, principal);
  EXPECT_GT(test::largest(sum), 0.1);
  for (int a = 0; a < 2; ++a) {
    EXPECT_NEAR(sum.segment(a * count, count).sum(), 0.0, 1e-12);
    for (const int side : {-1, 1}) {
      sum.segment(a * count, count) +=
          side * principal[a] * face_load<2, 2>(body, force_of, 0, 2 * a + (side > 0 ? 1 : 0), a);
    }
  }
  EXPECT_LT(test::largest(sum - force_of(stress)), 1e-12);
  faces[3].coordinate = 22.0;
  const Body<2> near(body.points(), faces, 1.0, whole->horizon(), InfluenceFunction::gaussian);
  EXPECT_THROW((face_load<2, 2>(near, force_of, 0, 3, 1)), BodyError);
}

/// A cylinder between faces that are rollers: what it bears is all that does not balance.
TEST(CurvedLoad, IsAllThatAHoleLeavesOpenBetweenRollers) {
  const Face hole{.name = "hole",
                  .axis = -1,
                  .direction = -1,
                  .coordinate = 2.7,
                  .centre = {8.1, 7.8},
                  .along = 2};
  const auto whole = test::box_body<3>({16, 16, 4}, 1.0);
  Points<3> points;
  for (Index i = 0; i < whole->points().size(); ++i) {
    if (hole.depth(whole->points().at(i)) > 0.0) points.add(whole->points().at(i), 1.0);
  }
  std::vector<Face> faces = whole->faces();
  faces.push_back(hole);
  const Body<3> body(std::move(points), std::move(faces), 1.0, whole->horizon(),
                     InfluenceFunction::gaussian);
  constexpr FaceSet planes = 0b111111;
  const auto family = body.family(planes);
  MirrorCondition<3, 3> rollers(*family);
  for (int face = 0; face < 6; ++face) rollers.set_odd(face, face / 2);
  const ForceOfStress force_of =
      test::force_by(gradient_matrix(*family, family_moments(*family), rollers));
  const Index count = body.points().size();
  const Vector<3> principal = {-1.3, 0.4, 0.9};
  Eigen::VectorXd stress = Eigen::VectorXd::Zero(9 * count);
  for (int a = 0; a < 3; ++a) stress.segment(4 * a * count, count).setConstant(principal[a]);
  const Eigen::VectorXd load = curved_load<3>(body, force_of, planes, hole, principal);
  EXPECT_GT(test::largest(load.head(2 * count)), 0.1);
  EXPECT_LT(test::largest(load.tail(count)), 1e-12);
  EXPECT_LT(test::largest(force_of(stress).head(3 * count) - load), 1e-12);
}

/// Of a notch the floor and the sides, not the face that it opens through.
TEST(CutoutLoad, LeavesTheFaceBesideANotchAlone) {
  const auto body = cut_body({"notch", {12.0, 13.0}, {17.0, 30.0}});
  const ForceOfStress force_of = free_force<2, 2>(*body);
  EXPECT_NEAR(cutout_load<2>(*body, force_of, 1).sum(), 5.0, 1e-12);
  EXPECT_NEAR(cutout_load<2>(*body, force_of, 0).sum(), 0.0, 1e-12);
  EXPECT_THROW(
      cutout_load<2>(*cut_body({"notch", {12.0, 20.0}, {17.0, 30.0}}),
                     free_force<2, 2>(*cut_body({"notch", {12.0, 20.0}, {17.0, 30.0}})), 1),
      BodyError);
}

/// The load of the top face where the bottom is mirrored evenly, which cuts the stress off there.
double load_above_a_sealed_face(int count) {
  const auto body = test::box_body<2>({8, count}, 1.0);
  const FaceSet mirrored = 0b0111;
  const auto family = body->family(mirrored);
  const ForceOfStress force_of = test::force_by(
      gradient_matrix(*family, family_moments(*family), MirrorCondition<2, 1>(*family)));
  return face_load<2, 1>(*body, force_of, mirrored, 3, 0).sum();
}

TEST(FaceLoad, RefusesABodyThatIsTooThin) {
  const auto body = test::box_body<2>({20, 9}, 1.0);
  const ForceOfStress force_of = free_force<2, 2>(*body);
  EXPECT_NO_THROW((face_load<2, 2>(*body, force_of, 0, 0, 0)));
  try {
    face_load<2, 2>(*body, force_of, 0, 3, 1);
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
