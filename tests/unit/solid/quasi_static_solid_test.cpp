#include "modules/solid/quasi_static_solid.hpp"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "core/operators/face_load.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "core/state/snapshot.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic_solid.hpp"

namespace perifrac {
namespace {

using test::lambda, test::mu, test::Solid;

/// Rollers on the low faces hold a body under uniform stress.
template <int D>
Solid<D> on_rollers(int count) {
  Solid<D> solid(test::cube<D>(count));
  for (int a = 0; a < D; ++a) solid.boundary.roller(2 * a, 0.0);
  return solid;
}

template <int D>
void expect_patch_under_traction(int count) {
  Solid<D> solid = on_rollers<D>(count);
  Vector<D> slope;
  for (int a = 0; a < D; ++a) slope[a] = 0.01 * (a + 1) * (a % 2 ? -1.0 : 1.0);
  const Vector<D> stress = solid.stress(slope);
  for (int a = 0; a < D; ++a) {
    Vector<D> traction{};
    traction[a] = stress[a];
    solid.boundary.traction(2 * a + 1, traction);
  }
  solid.start();
  solid.step();
  EXPECT_LT(solid.error(slope), 1e-12);
  const double energy = solid.energy_of(slope);
  EXPECT_NEAR(solid.port("elastic_energy").value[0], energy, 1e-12 * energy);
  EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy);
  const double dilatation = std::accumulate(slope.begin(), slope.end(), 0.0);
  for (const double theta : solid.port("dilatation").value) EXPECT_NEAR(theta, dilatation, 1e-13);
}

TEST(QuasiStaticSolid, IsLinearUnderUniformTraction) {
  expect_patch_under_traction<2>(9);
  expect_patch_under_traction<3>(8);
}

template <int D>
void expect_patch_under_plate(int count) {
  Solid<D> solid = on_rollers<D>(count);
  Vector<D> slope{};
  // Only the plate loads: stress -sigma along the last axis, none along the others.
  const double sigma = 0.3;
  const double young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
  const double nu = lambda / (2.0 * (lambda + mu));
  slope.fill(D == 2 ? sigma / young * nu * (1.0 + nu) : sigma / young * nu);
  slope[D - 1] = D == 2 ? -sigma / young * (1.0 - nu * nu) : -sigma / young;
  solid.boundary.rigid_plate(2 * D - 1, sigma * std::pow(count * 0.5, D - 1));
  solid.start();
  solid.step();
  EXPECT_LT(solid.error(slope), 1e-12);
  const double energy = solid.energy_of(slope);
  EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy);
}

TEST(QuasiStaticSolid, IsLinearUnderARigidPlate) {
  expect_patch_under_plate<2>(7);
  expect_patch_under_plate<3>(5);
}

template <int D>
void expect_patch_between_moved_rollers(int count) {
  Solid<D> solid = on_rollers<D>(count);
  Vector<D> slope;
  for (int a = 0; a < D; ++a) {
    slope[a] = 0.02 - 0.015 * a;
    solid.boundary.roller(2 * a + 1, slope[a] * count * 0.5);  // along the outward normal
  }
  solid.start();
  solid.step();
  EXPECT_LT(solid.error(slope), 1e-12);
  const double energy = solid.energy_of(slope);
  EXPECT_NEAR(solid.port("elastic_energy").value[0], energy, 1e-12 * energy);
  EXPECT_NEAR(solid.port("external_work").value[0], energy, 1e-12 * energy) << "of the reactions";
}

TEST(QuasiStaticSolid, IsLinearBetweenMovedRollers) {
  expect_patch_between_moved_rollers<2>(6);
  expect_patch_between_moved_rollers<3>(4);
}

/// All stresses, shear included, from tractions on all faces; a few unknowns take the rigid motions
/// and bear no force.
template <int D>
void expect_patch_with_shear(int count) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.5);
  const auto family = body->family(0);
  const MirrorCondition<D, D> mirror(*family);
  const IsotropicElasticity<D> law{lambda, mu};
  const LinearExactOperator<D, IsotropicElasticity<D>> op(family, mirror, law);
  const ForceOfStress force_of = test::force_of(op);
  const Points<D>& points = body->points();
  const Index n = points.size();
  Tensor<D, D> slope;
  for (int k = 0; k < D * D; ++k) slope[k] = 0.01 * k - 0.023;
  const Tensor<D, D> stress = law.stress(slope);
  SolidBoundary<D> boundary(*body);
  for (int face = 0; face < 2 * D; ++face) {
    Vector<D> traction;
    for (int a = 0; a < D; ++a) {
      traction[a] = body->faces()[face].direction * stress[a * D + face / 2];
    }
    boundary.traction(face, traction);
  }
  Eigen::VectorXd linear = Eigen::VectorXd::Zero(D * n);
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      for (Index i = 0; i < n; ++i) linear[a * n + i] += slope[a * D + b] * points.position[b][i];
    }
  }
  // Pins: all of a corner, what turns a second one about it, and in 3D a third.
  std::vector<bool> pinned(D * n, false);
  const double far = count * 0.5;
  for (int corner = 0; corner < D; ++corner) {
    Vector<D> x{};
    if (corner > 0) x[corner - 1] = far;
    for (int a = corner; a < D; ++a) pinned[a * n + body->nearest_point(x)] = true;
  }
  ASSERT_EQ(std::ranges::count(pinned, true), D * (D + 1) / 2);
  std::vector<Eigen::Triplet<double>> picks;
  Index row = 0;
  for (Index k = 0; k < D * n; ++k) {
    if (!pinned[k]) picks.emplace_back(row++, k, 1.0);
  }
  Eigen::SparseMatrix<double> loose(row, D * n);
  loose.setFromTriplets(picks.begin(), picks.end());
  const Eigen::VectorXd held = linear - loose.transpose() * (loose * linear);
  const Eigen::SparseMatrix<double> a = op.assemble();
  SparseCholesky factor;
  factor.factor(loose * a * loose.transpose());
  Eigen::VectorXd u(row);
  Eigen::VectorXd load(D * n);
  boundary.loads(mirror, force_of).at(0.0, load);
  factor.solve(loose * (load - a * held), u);
  // Pins leave a long lever to rounding: the matrix's condition is about 1e5.
  EXPECT_LT(test::largest(u - loose * linear), 1e-12 * test::largest(linear));
}

TEST(QuasiStaticSolid, IsLinearUnderAllStresses) {
  expect_patch_with_shear<2>(11);
  expect_patch_with_shear<3>(10);
}

TEST(QuasiStaticSolid, MovesWithAFixedFaceWithoutStress) {
  Solid<2> solid({6, 7});
  solid.boundary.fixed(0, {0.3, -0.2});
  solid.start();
  solid.step();
  const auto u = solid.port("displacement").value;
  for (Index i = 0; i < solid.points(); ++i) {
    EXPECT_NEAR(u[i], 0.3, 1e-12);
    EXPECT_NEAR(u[solid.points() + i], -0.2, 1e-12);
  }
  EXPECT_NEAR(solid.port("elastic_energy").value[0], 0.0, 1e-13);
  EXPECT_NEAR(solid.port("external_work").value[0], 0.0, 1e-13);
}

/// Uniform pore stress swells a body that is free to: by exactly what the port's slope says.
template <int D>
void expect_free_swelling(int count) {
  Solid<D> solid = on_rollers<D>(count);
  solid.start();
  std::ranges::fill(solid.port("pore_stress").value, 0.7);
  solid.step();
  const PortView dilatation = solid.port("dilatation");
  const auto slope = dilatation.slope;
  for (Index i = 0; i < solid.points(); ++i) {
    EXPECT_NEAR(dilatation.value[i], 0.7 * slope[i], 1e-12 * 0.7 * slope[i]);
  }
  Vector<D> expected;
  expected.fill(0.7 * slope[0] / D);
  EXPECT_LT(solid.error(expected), 1e-12);
}

TEST(QuasiStaticSolid, SwellsByThePoreStress) {
  expect_free_swelling<2>(6);
  expect_free_swelling<3>(5);
}

/// Change of elastic energy = external work + work of the pore stress, window by window.
template <int D>
void expect_energy_balance(int count) {
  Solid<D> solid(test::cube<D>(count));
  solid.boundary.fixed(0, {});
  solid.boundary.roller(2 * D - 2, 0.1);
  solid.boundary.rigid_plate(2 * D - 1, 0.2);
  Vector<D> force{};
  force[0] = 0.05;
  force[D - 1] = -0.1;
  solid.boundary.body_force(force);
  solid.start();
  std::vector<double> stress(solid.points(), 0.0), dilatation(solid.points(), 0.0);
  double elastic = 0.0, external = 0.0;
  for (unsigned window = 1; window <= 4; ++window) {
    const auto input = solid.port("pore_stress").value;
    const std::vector<double> next = test::random_values(input.size(), window);
    std::ranges::copy(next, input.begin());
    solid.step();
    const auto theta = solid.port("dilatation").value;
    double pore = 0.0;
    for (Index i = 0; i < solid.points(); ++i) {
      pore +=
          0.5 * solid.body->points().volume[i] * (stress[i] + next[i]) * (theta[i] - dilatation[i]);
    }
    const double elastic_now = solid.port("elastic_energy").value[0];
    const double external_now = solid.port("external_work").value[0];
    EXPECT_NEAR(elastic_now - elastic, external_now - external + pore, 1e-12 * elastic_now);
    EXPECT_GT(std::abs(external_now - external), 1e-6 * elastic_now) << "no trivial balance";
    elastic = elastic_now;
    external = external_now;
    stress = next;
    dilatation.assign(theta.begin(), theta.end());
  }
}

TEST(QuasiStaticSolid, BalancesEnergy) {
  expect_energy_balance<2>(7);
  expect_energy_balance<3>(4);
}

TEST(QuasiStaticSolid, SettlesUnderItsWeightAtSecondOrder) {
  std::vector<double> errors;
  for (const int count : {10, 20, 40}) {
    Solid<2> solid({6, count}, 1.0 / count);
    for (const int face : {0, 1, 2}) solid.boundary.roller(face, 0.0);
    solid.boundary.body_force({0.0, -1.0});
    solid.start();
    solid.step();
    const auto u = solid.port("displacement").value;
    double worst = 0.0;
    for (Index i = 0; i < solid.points(); ++i) {
      const double y = solid.body->points().position[1][i];
      const double exact = -(y - 0.5 * y * y) / (lambda + 2.0 * mu);
      worst = std::max(worst, std::abs(u[solid.points() + i] - exact));
    }
    errors.push_back(worst);
  }
  for (int k : {1, 2}) {
    const double order = std::log2(errors[k - 1] / errors[k]);
    RecordProperty("order_" + std::to_string(k), std::to_string(order));
    EXPECT_GE(order, 1.9);
  }
}

TEST(QuasiStaticSolid, RepeatsARestoredWindowBitForBit) {
  Solid<2> solid = on_rollers<2>(6);
  solid.boundary.rigid_plate(3, 0.2);
  solid.start();
  const auto outputs = [&] {
    std::vector<double> all;
    for (const char* name : {"displacement", "dilatation", "elastic_energy", "external_work"}) {
      const auto value = solid.port(name).value;
      all.insert(all.end(), value.begin(), value.end());
    }
    return all;
  };
  const auto load = [&](double stress) {
    std::ranges::fill(solid.port("pore_stress").value, stress);
  };
  const auto walk = [&](StateVisitor& visitor) { solid.module->visit_state(visitor); };
  load(0.1);
  solid.module->advance({0.0, 1.0});
  const std::vector<double> before = outputs();
  Snapshot saved;
  saved.save(walk);
  load(0.4);
  solid.module->advance({1.0, 2.0});
  const std::vector<double> first = outputs();
  saved.restore(walk);
  solid.module->on_restored(1.0);
  EXPECT_EQ(outputs(), before);
  solid.module->advance({1.0, 2.0});
  EXPECT_EQ(outputs(), first);
  EXPECT_NE(first, before);
}

}  // namespace
}  // namespace perifrac
