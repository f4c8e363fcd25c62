#include <cmath>

#include <gtest/gtest.h>

#include "tests/unit/solid/elastic_solid.hpp"
#include "tests/unit/solid/layered_box.hpp"

namespace perifrac {
namespace {

using test::lambda, test::mu, test::Solid, test::layered_box, test::layer_rows;

template <int D>
double sum_over_layer(const Solid<D>& solid, int face, int component,
                      std::span<const double> values) {
  double sum = 0.0;
  for (const Index i : solid.body->layer(face)) sum += values[component * solid.points() + i];
  return sum;
}

/// A column between a fixed layer below and a loaded one above, on rollers at its sides.
template <int D>
Solid<D> column(int height, double spacing = 0.5) {
  std::array<int, D> counts = test::cube<D>(4);
  counts[D - 1] = height;
  Solid<D> solid(layered_box<D>(counts, spacing, {2 * D - 2, 2 * D - 1}));
  for (int f = 0; f < 2 * D - 2; ++f) solid.boundary.roller(f, 0.0);
  solid.boundary.fixed(2 * D - 2, {});
  return solid;
}

/// Strain between points `reach` below and above the middle of the column.
template <int D>
double strain_in_the_middle(Solid<D>& solid, double reach) {
  const auto u = solid.port("displacement").value;
  const double middle = 0.5 * solid.body->faces()[2 * D - 1].coordinate;
  Vector<D> low{}, high{};
  low.fill(0.9);
  high.fill(0.9);
  low[D - 1] = middle - reach;
  high[D - 1] = middle + reach;
  const Index i = solid.body->nearest_point(low), j = solid.body->nearest_point(high);
  const auto& z = solid.body->points().position[D - 1];
  return (u[(D - 1) * solid.points() + j] - u[(D - 1) * solid.points() + i]) / (z[j] - z[i]);
}

template <int D>
void expect_uniform_strain_under_traction(int height) {
  Solid<D> solid = column<D>(height);
  Vector<D> traction{};
  traction[D - 1] = -0.3;
  solid.boundary.traction(2 * D - 1, traction);
  EXPECT_FALSE(contains(solid.boundary.mirrored(), 2 * D - 1));
  solid.start();
  solid.step();
  const double exact = -0.3 / (lambda + 2.0 * mu);
  EXPECT_NEAR(strain_in_the_middle(solid, 0.7), exact, 1e-5 * std::abs(exact));
  const double force = -0.3 * std::pow(2.0, D - 1);
  const auto external = solid.external_force();
  EXPECT_NEAR(sum_over_layer(solid, 2 * D - 1, D - 1, external), force, 1e-12);
  EXPECT_NEAR(sum_over_layer(solid, 2 * D - 2, D - 1, external), -force, 1e-11) << "reaction";
  for (const Index i : solid.body->layer(2 * D - 2)) {
    for (int a = 0; a < D; ++a) {
      EXPECT_EQ(solid.port("displacement").value[a * solid.points() + i], 0.0);
    }
  }
}

TEST(LayeredSolid, StrainsUniformlyUnderTraction) {
  expect_uniform_strain_under_traction<2>(24);
  expect_uniform_strain_under_traction<3>(16);
}

TEST(LayeredSolid, TakesAShearTraction) {
  Solid<2> solid(layered_box<2>({24, 6}, 0.5, {0, 1}));
  solid.boundary.fixed(0, {});
  solid.boundary.traction(1, {0.0, 0.2});
  solid.start();
  solid.step();
  const auto external = solid.external_force();
  EXPECT_NEAR(sum_over_layer(solid, 1, 1, external), 0.2 * 3.0, 1e-12);
  EXPECT_NEAR(sum_over_layer(solid, 0, 1, external), -0.2 * 3.0, 1e-11);
  // The couple of the two is balanced within the fixed layer.
  double moment = 0.0;
  const auto& x = solid.body->points().position;
  for (Index i = 0; i < solid.points(); ++i) {
    moment += x[0][i] * external[solid.points() + i] - x[1][i] * external[i];
  }
  EXPECT_NEAR(moment, 0.0, 1e-10);
}

template <int D>
void expect_rigid_layer_under_plate(int height) {
  Solid<D> solid = column<D>(height);
  const double force = 0.3 * std::pow(2.0, D - 1);
  solid.boundary.rigid_plate(2 * D - 1, force);
  solid.start();
  solid.step();
  const double exact = -0.3 / (lambda + 2.0 * mu);
  EXPECT_NEAR(strain_in_the_middle(solid, 0.7), exact, 1e-5 * std::abs(exact));
  const double plate = solid.port("top_plate_displacement").value[0];
  EXPECT_LT(plate, 0.0);
  const auto u = solid.port("displacement").value;
  for (const Index i : solid.body->layer(2 * D - 1)) {
    EXPECT_EQ(u[(D - 1) * solid.points() + i], plate);
  }
  const auto external = solid.external_force();
  EXPECT_NEAR(sum_over_layer(solid, 2 * D - 1, D - 1, external), -force, 1e-11);
  EXPECT_NEAR(sum_over_layer(solid, 2 * D - 2, D - 1, external), force, 1e-11);
  const double energy = solid.port("elastic_energy").value[0];
  EXPECT_NEAR(energy, -0.5 * force * plate, 1e-12 * energy);
  EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy);
}

TEST(LayeredSolid, GivesAPlatesLayerOneNormalDisplacement) {
  expect_rigid_layer_under_plate<2>(24);
  expect_rigid_layer_under_plate<3>(16);
}

TEST(LayeredSolid, LeavesAPlatesLayerFreeToSlide) {
  // Without rollers at the sides the body bulges, its plate's layer too.
  Solid<2> solid(layered_box<2>({8, 12}, 0.5, {2, 3}));
  solid.boundary.roller(0, 0.0);
  solid.boundary.roller(2, 0.0);
  solid.boundary.rigid_plate(3, 1.0);
  solid.start();
  solid.step();
  const auto u = solid.port("displacement").value;
  const auto& points = solid.body->points();
  double least = INFINITY, most = -INFINITY;
  for (const Index i : solid.body->layer(3)) {
    if (points.position[0][i] < 3.7) continue;
    least = std::min(least, u[i]);
    most = std::max(most, u[i]);
  }
  EXPECT_GT(least, 0.01);
  EXPECT_GT(most, 1.01 * least);
}

TEST(LayeredSolid, MovesALayerOnARollerByItsDisplacementAndVelocity) {
  Solid<2> solid = column<2>(12);
  solid.boundary.roller(3, 0.02, 0.001, Schedule::ramp(4.0));
  solid.start();
  solid.step();
  solid.step(2.0);
  const auto u = solid.port("displacement").value;
  for (const Index i : solid.body->layer(3)) {
    EXPECT_NEAR(u[solid.points() + i], 0.75 * 0.02 + 3.0 * 0.001, 1e-16);
  }
  // The rock strains from somewhat inside one layer to somewhat inside the other.
  EXPECT_LT(strain_in_the_middle(solid, 0.7), 0.018 / 6.0);
  EXPECT_GT(strain_in_the_middle(solid, 0.7), 0.018 / 7.0);
}

TEST(LayeredSolid, LetsTheStricterConditionHoldWhereLayersMeet) {
  const auto body = layered_box<2>({6, 6}, 0.5, {1, 3});
  SolidBoundary<2> boundary(*body);
  boundary.rigid_plate(1, 1.0);
  boundary.fixed(3, {0.1, 0.2});
  const auto mirror = boundary.mirror_condition(*body->family(boundary.mirrored()));
  const Eigen::SparseMatrix<double> free = boundary.free_unknowns(mirror);
  ASSERT_EQ(boundary.plates(mirror).size(), 1u);
  EXPECT_EQ(boundary.plates(mirror)[0].face, "right");
  EXPECT_EQ(boundary.plates(mirror)[0].column, free.cols() - 1);
  Eigen::VectorXd held(free.rows());
  boundary.prescribed(mirror).at(0.0, held);
  const Eigen::VectorXd moved = free * Eigen::VectorXd::Ones(free.cols());
  const auto& x = body->points().position;
  const Index n = body->points().size();
  const double plate_area = Eigen::VectorXd(free.col(free.cols() - 1)).sum();
  EXPECT_EQ(plate_area, 6.0 * layer_rows) << "points of its layer that the fixed one leaves it";
  for (Index i = 0; i < n; ++i) {
    const bool fixed = x[1][i] > 3.0;
    for (int a = 0; a < 2; ++a) {
      EXPECT_EQ(moved[a * n + i], fixed ? 0.0 : 1.0);
      EXPECT_EQ(held[a * n + i], fixed ? 0.1 * (a + 1) : 0.0);
    }
  }
}

TEST(LayeredSolid, IsHeldByItsLayers) {
  Solid<2> solid(layered_box<2>({6, 6}, 0.5, {0, 2, 3}));
  const auto free_motion = [&] {
    return QuasiStaticSolid<2>(solid.body,
                               test::elastic<2>(*solid.body, solid.boundary, {1e9, 1e9}),
                               solid.boundary)
        .free_motion();
  };
  EXPECT_NE(free_motion(), "");
  solid.boundary.roller(0, 0.0);
  EXPECT_EQ(free_motion(), "it can slide along y");
  solid.boundary.rigid_plate(2, 1.0);
  EXPECT_EQ(free_motion(), "it can slide along y") << "a layer's plate moves along";
  solid.boundary.rigid_plate(3, 1.0);
  EXPECT_EQ(free_motion(), "it can slide along y") << "two plates move along";
  solid.boundary.roller(2, 0.0);
  EXPECT_EQ(free_motion(), "");
  solid.boundary = SolidBoundary<2>(*solid.body);
  solid.boundary.fixed(3, {});
  EXPECT_EQ(free_motion(), "");
}

/// Settlement of the middle of a heavy column on a fixed layer, its top free.
double middle_settlement_error(int count, double face_inside) {
  const double spacing = 1.0 / count;
  Solid<2> solid(layered_box<2>({4, count}, spacing, {2}));
  for (const int f : {0, 1}) solid.boundary.roller(f, 0.0);
  solid.boundary.fixed(2, {});
  solid.boundary.gravity(2.0, {0.0, -5.0});
  solid.start();
  solid.step();
  const Index i = solid.body->nearest_point({0.0, 0.5});
  const double foot = -face_inside * spacing;  // the effective face's coordinate
  const double y = solid.body->points().position[1][i];
  const auto drop = [](double depth) { return -0.5 * 10.0 * depth * depth; };
  const double exact = (drop(1.0 - foot) - drop(1.0 - y)) / (lambda + 2.0 * mu);
  return std::abs(solid.port("displacement").value[solid.points() + i] - exact) / std::abs(exact);
}

TEST(LayeredSolid, IsFirstOrderBecauseItsFaceLiesInside) {
  std::vector<double> errors;
  for (const int count : {10, 20, 40}) {
    errors.push_back(middle_settlement_error(count, 0.0));
    EXPECT_LT(middle_settlement_error(count, 0.83), 0.02 * errors.back());
  }
  for (const int k : {1, 2}) {
    const double order = std::log2(errors[k - 1] / errors[k]);
    RecordProperty("order_" + std::to_string(k), std::to_string(order));
    EXPECT_GE(order, 0.95);
  }
}

}  // namespace
}  // namespace perifrac
