#include "modules/solid/material/lps_elasticity.hpp"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <omp.h>

#include "core/bonds/bond_traversal.hpp"
#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"
#include "tests/unit/solid/elastic.hpp"

namespace perifrac {
namespace {

using test::Cloud;
using test::OddFaces;

/// Two rocks, a pore stress and an initial stress on a body with mirrored faces.
template <int D>
struct Setting {
  std::shared_ptr<const Body<D>> body;
  FaceSet mirrored = 0;
  OddFaces<D, D> odd{};
  std::vector<double> pore_stress = test::random_values(body->points().volume.size(), 3);
  std::optional<Vector<D>> initial_stress{};

  LawByRegion<IsotropicElasticity<D>> law() const {
    LawByRegion<IsotropicElasticity<D>> law{{{3.0, 2.0}, {0.5, 1.5}}, {}};
    law.law_of_point.resize(body->points().volume.size());
    for (std::size_t i = 0; i < law.law_of_point.size(); ++i) law.law_of_point[i] = i % 3 == 0;
    return law;
  }

  LpsElasticity<D> make() const {
    const auto family = body->family(mirrored);
    return {family, odd.mirror_condition(*family), law(), initial_stress};
  }
};

/// Faces free; on rollers; fixed; even in every component; fixed beside rollers, so that corners of
/// two and three faces are odd in some components and even in others; all of them under initial
/// stress too.
template <int D>
std::vector<Setting<D>> settings(int count, Cloud cloud) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.8, cloud);
  const FaceSet all = face_bit(2 * D) - 1;
  Setting<D> free{body}, rollers{body, all}, fixed{body, all}, even{body, all}, mixed{body, all};
  Setting<D> one{body, 0b0010};
  for (int face = 0; face < 2 * D; ++face) {
    rollers.odd.pairs.push_back({face, face / 2});
    for (int r = 0; r < D; ++r) {
      if (face == 0) one.odd.pairs.push_back({1, r});
      fixed.odd.pairs.push_back({face, r});
      if (face < 3 || r == face / 2) mixed.odd.pairs.push_back({face, r});
    }
  }
  std::vector<Setting<D>> all_settings = {free, rollers, fixed, even, mixed, one};
  Vector<D> stress;
  for (int a = 0; a < D; ++a) stress[a] = 0.6 - a;
  for (std::size_t k = 0, end = all_settings.size(); k < end; ++k) {
    all_settings.push_back(all_settings[k]);
    all_settings.back().initial_stress = stress;
  }
  return all_settings;
}

/// The energy by its definition, over all pairs of points and images.
template <int D>
double energy_of(const Setting<D>& setting, const std::vector<test::Node<D>>& nodes,
                 std::span<const double> u) {
  using Matrix = Eigen::Matrix<double, D, D>;
  using Arrow = Eigen::Matrix<double, D, 1>;
  const Points<D>& points = setting.body->points();
  const double horizon = setting.body->horizon();
  const auto law = setting.law();
  double energy = 0.0;
  for (Index i = 0; i < points.size(); ++i) {
    const auto [lambda, mu] = law.at(i);
    const Vector<D> x = points.at(i);
    double m = 0.0, volume = 0.0, stretch = 0.0;
    Matrix shape = Matrix::Zero(), moment = Matrix::Zero();
    for (const test::Node<D>& node : nodes) {
      const double r = test::distance<D>(x, node.x);
      if (r == 0.0 || r > horizon * (1.0 + 1e-9)) continue;
      Arrow xi, difference;
      for (int a = 0; a < D; ++a) {
        xi[a] = node.x[a] - x[a];
        difference[a] = setting.odd.value(node, a, points.size(), u) - u[a * points.size() + i];
      }
      const double w = std::exp(-std::pow(r / (0.4 * horizon), 2)) * points.volume[node.source];
      m += w * r * r;
      volume += w * xi.dot(difference);
      stretch += w * std::pow(xi.dot(difference) / r, 2);
      shape += w * xi * xi.transpose();
      moment += w * difference * xi.transpose();
    }
    const double theta = D / m * volume;
    const double c = (D == 2 ? 8.0 : 15.0) * mu;
    double density = 0.5 * (lambda - mu) * theta * theta + 0.5 * c / m * stretch -
                     setting.pore_stress[i] * theta;
    const Matrix gradient = moment * shape.inverse();
    for (int a = 0; a < D && setting.initial_stress; ++a) {
      density += (*setting.initial_stress)[a] * gradient(a, a);
    }
    energy += points.volume[i] * density;
  }
  return energy;
}

template <int D>
void expect_force_is_the_energys_derivative(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D>& setting : settings<D>(count, cloud)) {
      auto solid = setting.make();
      const Index points = setting.body->points().size();
      const auto nodes =
          test::all_images<D>(setting.body->points(), setting.body->faces(), setting.mirrored);
      const std::vector<double> u = test::random_values(solid.size());
      std::vector<double> force(solid.size()), dilatation(points);
      solid.apply(u, {setting.pore_stress}, force, dilatation);
      const double scale = test::largest(force);
      // The energy is quadratic: a central difference of any width is exact but for rounding.
      std::vector<Index> checked(setting.odd.pairs.size());
      std::iota(checked.begin(), checked.end(), D * points);
      for (Index k = 0; k < D * points; k += D * points / 13) checked.push_back(k);
      for (const Index k : checked) {
        std::vector<double> up = u, down = u;
        up[k] += 0.5;
        down[k] -= 0.5;
        const double expected = energy_of(setting, nodes, up) - energy_of(setting, nodes, down);
        ASSERT_NEAR(force[k], expected, 1e-11 * scale) << "unknown " << k;
      }
    }
  }
}

TEST(LpsElasticity, IsTheDerivativeOfItsEnergy) {
  expect_force_is_the_energys_derivative<2>(6);
  expect_force_is_the_energys_derivative<3>(4);
}

template <int D>
void expect_matrices_are_the_operator(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D>& setting : settings<D>(count, cloud)) {
      auto solid = setting.make();
      const Eigen::SparseMatrix<double> a = solid.assemble();
      const double scale = a.diagonal().maxCoeff();
      const Eigen::SparseMatrix<double> skew = a - Eigen::SparseMatrix<double>(a.transpose());
      EXPECT_LT(skew.coeffs().abs().maxCoeff(), 1e-13 * scale);

      const Index points = setting.body->points().size();
      const std::vector<double> u = test::random_values(solid.size());
      std::vector<double> force(solid.size()), dilatation(points);
      solid.apply(u, {setting.pore_stress}, force, dilatation);
      const std::vector<double> initial = solid.initial_force();
      std::vector<double> pore_force(solid.size(), 0.0);
      solid.add_pore_force(setting.pore_stress, pore_force);
      const Eigen::VectorXd pore = test::as_eigen(pore_force);
      const double work = test::as_eigen(setting.body->points().volume)
                              .cwiseProduct(test::as_eigen(setting.pore_stress))
                              .dot(test::as_eigen(dilatation));
      EXPECT_NEAR(pore.dot(test::as_eigen(u)) / work, 1.0, 1e-12);
      EXPECT_LT(test::largest(a * test::as_eigen(u) - pore + test::as_eigen(initial) -
                              test::as_eigen(force)),
                1e-12 * scale);
      EXPECT_EQ(test::largest(initial) > 0.0, setting.initial_stress.has_value());
    }
  }
}

TEST(LpsElasticity, AssemblesTheMatricesThatItApplies) {
  expect_matrices_are_the_operator<2>(6);
  expect_matrices_are_the_operator<3>(4);
}

template <int D>
void expect_slope_of_pore_stress(int count) {
  const Setting<D> setting{test::box_body<D>(test::cube<D>(count), 0.8)};
  auto solid = setting.make();
  const std::size_t points = setting.body->points().volume.size();
  const std::vector<double> u = test::random_values(solid.size());
  const std::vector<double> slope = test::random_values(points, 8);
  std::vector<double> force(solid.size()), expected(solid.size()), dilatation(points);
  solid.apply(u, {setting.pore_stress, slope}, force, dilatation);
  std::vector<double> whole = setting.pore_stress;
  for (std::size_t i = 0; i < points; ++i) whole[i] += slope[i] * dilatation[i];
  solid.apply(u, {whole}, expected, dilatation);
  // To a rounding: compilers fuse the product and the sum there, or here.
  const double rounding = 1e-14 * test::largest(force);
  EXPECT_THAT(force, testing::Pointwise(testing::DoubleNear(rounding), expected));
}

TEST(LpsElasticity, AddsTheSlopeOfThePoreStress) {
  expect_slope_of_pore_stress<2>(6);
  expect_slope_of_pore_stress<3>(4);
}

template <int D>
void expect_momentum_kept(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D>& setting : settings<D>(count, cloud)) {
      auto solid = setting.make();
      const Index points = setting.body->points().size();
      const std::vector<double> u = test::random_values(solid.size());
      std::vector<double> force(solid.size()), dilatation(points);
      solid.apply(u, {setting.pore_stress}, force, dilatation);
      for (int r = 0; r < D; ++r) {
        double sum =
            std::accumulate(force.begin() + r * points, force.begin() + (r + 1) * points, 0.0);
        for (std::size_t k = 0; k < setting.odd.pairs.size(); ++k) {
          if (setting.odd.pairs[k].component == r) sum += force[D * points + k];
        }
        EXPECT_NEAR(sum, 0.0, 1e-12 * test::largest(force)) << "along " << r;
      }
    }
  }
}

TEST(LpsElasticity, KeepsMomentum) {
  expect_momentum_kept<2>(7);
  expect_momentum_kept<3>(4);
}

template <int D>
void expect_rigid_motions_free(int count) {
  const Setting<D> setting{test::box_body<D>(test::cube<D>(count), 0.8, Cloud::jittered)};
  auto solid = setting.make();
  const Points<D>& points = setting.body->points();
  const Index n = points.size();
  std::vector<double> u(solid.size()), force(solid.size()), dilatation(n);
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < D; ++a) {
      u[a * n + i] = 0.3 - a;
      for (int b = 0; b < D; ++b) {
        if (a != b) u[a * n + i] += (a < b ? 1.0 : -1.0) * (a + b) * points.position[b][i];
      }
    }
  }
  solid.apply(u, {}, force, dilatation);
  const double scale = solid.assemble().diagonal().maxCoeff() * test::largest(u);
  EXPECT_LT(test::largest(force), 1e-13 * scale);
  EXPECT_LT(test::largest(dilatation), 1e-12);
  // Momentum of momentum: the forces of any motion turn nothing.
  const std::vector<double> any = test::random_values(solid.size());
  solid.apply(any, {setting.pore_stress}, force, dilatation);
  EXPECT_NEAR(test::as_eigen(u).dot(test::as_eigen(force)), 0.0, 1e-12 * scale);
}

TEST(LpsElasticity, LeavesRigidMotionsWithoutEnergy) {
  expect_rigid_motions_free<2>(7);
  expect_rigid_motions_free<3>(4);
}

/// u = epsilon x between moved rollers, under uniform pore stress: in equilibrium, with the exact
/// stress behind every face.
template <int D>
void expect_isotropic_patch(int count) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.5);
  SolidBoundary<D> boundary(*body);
  const double epsilon = 0.01, length = 0.5 * count, pore = 0.2;
  for (int face = 0; face < 2 * D; ++face) boundary.roller(face, face % 2 ? epsilon * length : 0.0);
  const IsotropicElasticity<D> law{3.0, 2.0};
  const auto solid = test::lps<D>(*body, boundary, law);
  const auto mirror = boundary.mirror_condition(*body->family(boundary.mirrored()));
  const Index points = body->points().size();
  Eigen::VectorXd u(solid->size());
  boundary.prescribed(mirror).at(0.0, u);
  for (int a = 0; a < D; ++a) {
    for (Index i = 0; i < points; ++i) u[a * points + i] = epsilon * body->points().position[a][i];
  }
  const std::vector<double> pore_stress(points, pore);
  std::vector<double> force(u.size()), dilatation(points), stress(D * D * points);
  const std::span<const double> displacement(u.data(), u.size());
  solid->apply(displacement, {pore_stress}, force, dilatation);
  const double effective = D * epsilon * law.drained_bulk_modulus();
  const double area = std::pow(length, D - 1);
  for (Index k = 0; k < D * points; ++k) ASSERT_NEAR(force[k], 0.0, 1e-13);
  for (int face = 0; face < 2 * D; ++face) {
    const double sign = body->faces()[face].direction;
    const int row = D * points + mirror.face_value(face, face / 2);
    EXPECT_NEAR(force[row], sign * (effective - pore) * area, 1e-12 * area);
  }
  solid->stress(displacement, stress);
  for (Index i = 0; i < points; ++i) {
    ASSERT_NEAR(dilatation[i], D * epsilon, 1e-14);
    for (int k = 0; k < D * D; ++k) {
      ASSERT_NEAR(stress[k * points + i], k % (D + 1) == 0 ? effective : 0.0, 1e-13);
    }
  }
}

TEST(LpsElasticity, IsExactForIsotropicDeformation) {
  expect_isotropic_patch<2>(6);
  expect_isotropic_patch<3>(4);
}

/// The sign of the pore stress decides which way a free body under pore pressure goes, in its
/// forces as in its energy.
TEST(LpsElasticity, TurnsThePoreStressAsItIsTold) {
  const auto body = test::box_body<2>({7, 6}, 0.5);
  const auto family = body->family(0);
  const MirrorCondition<2, 2> mirror(*family);
  const Index n = body->points().size();
  const LawByRegion<IsotropicElasticity<2>> law{{{3.0, 2.0}}, std::vector<std::uint8_t>(n, 0)};
  LpsElasticity<2> right(family, mirror, law), turned(family, mirror, law, {}, -1.0);
  const std::vector<double> u(right.size(), 0.0), pore = test::random_values(n, 3);
  std::vector<double> one(u.size()), other(u.size()), dilatation(n);
  right.apply(u, {pore}, one, dilatation);
  turned.apply(u, {pore}, other, dilatation);
  EXPECT_GT(test::largest(one), 0.1);
  for (std::size_t k = 0; k < one.size(); ++k) ASSERT_EQ(other[k], -one[k]);
}

/// The stress is what does work on a uniform gradient: sum V sigma : F = dE/dF, on any cloud.
TEST(LpsElasticity, GivesTheStressThatWorksOnAGradient) {
  Setting<2> setting{test::box_body<2>({7, 6}, 0.5, Cloud::jittered)};
  std::ranges::fill(setting.pore_stress, 0.0);
  setting.initial_stress = {{-0.4, 0.7}};
  auto solid = setting.make();
  const Points<2>& points = setting.body->points();
  const Index n = points.size();
  const std::vector<double> u = test::random_values(solid.size());
  std::vector<double> force(solid.size()), dilatation(n), stress(4 * n);
  solid.apply(u, {}, force, dilatation);
  solid.stress(u, stress);
  for (int k = 0; k < 4; ++k) {
    double work = 0.0, expected = 0.0;
    for (Index i = 0; i < n; ++i) {
      work += force[k / 2 * n + i] * points.position[k % 2][i];
      expected += points.volume[i] * stress[k * n + i];
    }
    EXPECT_NEAR(work, expected, 1e-12 * test::largest(force) * n);
  }
}

/// By packets of a lattice as by the bonds one by one; faces are mirrored and bonds broken.
template <int D>
void expect_same_stress(const std::array<int, D>& counts) {
  Setting<D> setting{test::box_body<D>(counts, 0.5), 0b0110};
  Vector<D> initial;
  for (int a = 0; a < D; ++a) initial[a] = 0.3 * a - 0.4;
  setting.initial_stress = initial;
  const auto family = std::make_shared<Family<D>>(*setting.body->family(setting.mirrored));
  LpsElasticity<D> solid(family, setting.odd.mirror_condition(*family), setting.law(), initial);
  ASSERT_TRUE(solid.path().starts_with("packets")) << solid.path();
  const Index n = setting.body->points().size();
  const Index end = family->bonds(n / 2).other(1);
  silence(*family, n / 2, end);
  solid.update(std::array{std::min(n / 2, end), std::max(n / 2, end)});
  const std::vector<double> u = test::random_values(solid.size());
  std::vector<double> stress(D * D * n);
  solid.stress(u, stress);
  const DeformedMaterial<D> deformed = solid.deform(u);
  for (Index i = 0; i < n; ++i) {
    const Tensor<D, D> expected = deformed.stress(i, deformed.gradient(i));
    for (int k = 0; k < D * D; ++k) {
      const double at_rest = k / D == k % D ? initial[k / D] : 0.0;
      ASSERT_NEAR(stress[k * n + i], expected[k] + at_rest, 1e-12 * test::largest(stress));
    }
  }
}

TEST(LpsElasticity, GivesTheSameStressByPackets) {
  expect_same_stress<2>({9, 8});
  expect_same_stress<3>({6, 5, 7});
}

template <int D>
void expect_same_bits(const std::array<int, D>& counts) {
  Setting<D> setting{test::box_body<D>(counts, 1.0, Cloud::jittered), 0b0110};
  setting.odd.pairs = {{1, 0}, {1, 1}, {2, D - 1}};
  auto solid = setting.make();
  ASSERT_GE(setting.body->points().size(), points_worth_threads);
  const std::vector<double> u = test::random_values(solid.size());
  std::vector<double> dilatation(setting.body->points().volume.size());
  const int threads = omp_get_max_threads();
  std::vector<std::vector<double>> forces;
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    forces.emplace_back(solid.size());
    solid.apply(u, {setting.pore_stress}, forces.back(), dilatation);
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(forces[0], forces[2]);
}

TEST(LpsElasticity, GivesTheSameBitsAtAnyThreadCount) {
  expect_same_bits<2>({95, 90});
  expect_same_bits<3>({21, 20, 20});
}

}  // namespace
}  // namespace perifrac
