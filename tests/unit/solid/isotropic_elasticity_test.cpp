#include "modules/solid/material/isotropic_elasticity.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <numeric>
#include <unistd.h>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/errors.hpp"
#include "core/config/scene.hpp"
#include "core/operators/linear_exact.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

IsotropicElasticity<3> read_material(const std::string& constants) {
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("perifrac_elasticity_{}.yaml", getpid());
  std::ofstream(path) << "dimension: 3\nsolid: {type: quasi_static, material: {" << constants
                      << "}}\n";
  const Catalogue catalogue = {
      {"",
       "",
       {{.path = "dimension", .type = KeyType::integer, .required = true, .meaning = "Of space."}}},
      {"solid", "quasi_static", elastic_constant_keys()}};
  const Section scene = read_scene(path.string(), {}, catalogue);
  std::filesystem::remove(path);
  return read_isotropic_elasticity<3>(scene.at("solid"));
}

TEST(IsotropicElasticity, IsTheSameFromAnyTwoConstants) {
  const double lambda = 3.1e9, mu = 1.7e9;
  const std::map<std::string, double> constants = {
      {"youngs_modulus", mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu)},
      {"poisson_ratio", lambda / (2.0 * (lambda + mu))},
      {"bulk_modulus", lambda + 2.0 / 3.0 * mu},
      {"shear_modulus", mu},
      {"lame_lambda", lambda}};
  int pairs = 0;
  for (auto a = constants.begin(); a != constants.end(); ++a) {
    for (auto b = std::next(a); b != constants.end(); ++b, ++pairs) {
      const auto law = read_material(
          fmt::format("{}: {:.17g}, {}: {:.17g}", a->first, a->second, b->first, b->second));
      EXPECT_NEAR(law.lame_lambda, lambda, 1e-13 * lambda) << a->first << ", " << b->first;
      EXPECT_NEAR(law.shear_modulus, mu, 1e-13 * mu) << a->first << ", " << b->first;
    }
  }
  EXPECT_EQ(pairs, 10);
}

TEST(IsotropicElasticity, RefusesConstantsThatAreNoSolid) {
  EXPECT_THROW(read_material("youngs_modulus: 1e9"), InputError);
  EXPECT_THROW(read_material("youngs_modulus: 1e9, shear_modulus: 0.2e9"), InputError);  // K < 0
  EXPECT_THROW(read_material("bulk_modulus: 1e9, lame_lambda: 2e9"), InputError);        // mu < 0
  EXPECT_THROW(read_material("poisson_ratio: 0, lame_lambda: 1e9"), InputError);
}

TEST(IsotropicElasticity, ObeysHookesLaw) {
  const IsotropicElasticity<3> law{3.0, 2.0};
  const Tensor<3, 3> pull = law.stress(Tensor<3, 3>{0.1, 0, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_DOUBLE_EQ(pull[0], (3.0 + 2.0 * 2.0) * 0.1);
  EXPECT_DOUBLE_EQ(pull[4], 3.0 * 0.1);
  EXPECT_DOUBLE_EQ(pull[8], 3.0 * 0.1);
  const Tensor<3, 3> shear = law.stress(Tensor<3, 3>{0, 0.1, 0, 0, 0, 0, 0, 0, 0});
  EXPECT_DOUBLE_EQ(shear[1], 0.2);
  EXPECT_DOUBLE_EQ(shear[3], 0.2);
  for (const double s : law.stress(Tensor<3, 3>{0, 0.1, 0, -0.1, 0, 0, 0, 0, 0})) EXPECT_EQ(s, 0.0);
  EXPECT_DOUBLE_EQ(law.drained_bulk_modulus(), 3.0 + 4.0 / 3.0);
  EXPECT_DOUBLE_EQ((IsotropicElasticity<2>{3.0, 2.0}.drained_bulk_modulus()), 5.0);
}

template <int D>
LinearExactOperator<D, IsotropicElasticity<D>> free_solid(const Body<D>& body) {
  const auto family = body.family(0);
  return {family, MirrorCondition<D, D>(*family), {1.3, 0.9}};
}

/// The rigid motions, and nothing else, cost no energy.
template <int D>
void expect_null_modes(const Body<D>& body) {
  const Eigen::MatrixXd a = free_solid<D>(body).assemble();
  const Eigen::VectorXd values = symmetric_spectrum(a).values;
  const int rigid = D * (D + 1) / 2;
  const double top = values[values.size() - 1];
  EXPECT_LT(values.head(rigid).cwiseAbs().maxCoeff(), 1e-13 * top);
  EXPECT_GT(values[rigid], 1e-3 * top);
  ::testing::Test::RecordProperty(
      fmt::format("{}D_{}_points", D, body.points().size()),
      fmt::format("rigid {:.1e}, next {:.1e}", values.head(rigid).cwiseAbs().maxCoeff() / top,
                  values[rigid] / top));
}

TEST(SolidOperator, HasOnlyTheRigidMotionsAsNullModes) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_null_modes<2>(*test::box_body<2>({7, 6}, 0.5, cloud));
    expect_null_modes<3>(*test::box_body<3>({4, 4, 5}, 0.5, cloud));
  }
  expect_null_modes<2>(*test::ball_body<2>(3.2, 1.0));
  expect_null_modes<3>(*test::ball_body<3>(2.6, 1.0));
}

/// Forces add up to no force and no moment, whatever the displacement.
template <int D>
void expect_no_resultant(const Body<D>& body) {
  auto op = free_solid<D>(body);
  const std::vector<double> u = test::random_values(op.size());
  std::vector<double> force(op.size());
  op.apply(u, force);
  const Index n = body.points().size();
  const double scale = test::largest(force);
  for (int a = 0; a < D; ++a) {
    EXPECT_NEAR(std::accumulate(force.begin() + a * n, force.begin() + (a + 1) * n, 0.0), 0.0,
                1e-12 * scale);
    for (int b = a + 1; b < D; ++b) {
      double moment = 0.0;
      for (Index i = 0; i < n; ++i) {
        moment += body.points().position[a][i] * force[b * n + i] -
                  body.points().position[b][i] * force[a * n + i];
      }
      EXPECT_NEAR(moment, 0.0, 1e-11 * scale);
    }
  }
}

TEST(SolidOperator, KeepsMomentumAndAngularMomentum) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_no_resultant<2>(*test::box_body<2>({9, 8}, 0.5, cloud));
    expect_no_resultant<3>(*test::box_body<3>({5, 4, 6}, 0.5, cloud));
  }
  expect_no_resultant<3>(*test::ball_body<3>(3.1, 1.0));
}

}  // namespace
}  // namespace perifrac
