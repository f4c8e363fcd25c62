#include "core/operators/linear_exact.hpp"

#include <numeric>

#include <gtest/gtest.h>
#include <omp.h>

#include "tests/unit/operators/any_law.hpp"
#include "tests/unit/operators/brute_force.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::AnyLaw;
using test::Cloud;
using test::OddFaces;

template <int D, int R>
struct Setting {
  std::shared_ptr<const Body<D>> body;
  FaceSet mirrored = 0;
  OddFaces<D, R> odd{};

  LinearExactOperator<D, AnyLaw<R, D>> make() const {
    const auto family = body->family(mirrored);
    return {family, odd.mirror_condition(*family), AnyLaw<R, D>{}};
  }
};

/// Free faces; every kind of mirrored face; corners of two and of three odd faces; balls.
template <int D, int R>
std::vector<Setting<D, R>> settings(int count, Cloud cloud) {
  const auto body = test::box_body<D>(test::cube<D>(count), 0.8, cloud);
  const FaceSet all = face_bit(2 * D) - 1;
  Setting<D, R> free{body}, sealed{body, all}, mixed{body, 0b0110}, held{body, all};
  mixed.odd.pairs = {{1, 0}, {2, R - 1}};
  for (int face = 0; face < 2 * D; face += 2) {
    for (int r = 0; r < R; ++r) held.odd.pairs.push_back({face, r});
  }
  held.odd.pairs.push_back({2 * D - 1, R - 1});
  // Sphere and planes, in every mixture of even and odd; a ball shorter than the box is fast.
  const auto octant = test::ball_body<D>(0.7 * count, 0.8, true);
  const FaceSet with_planes = face_bit(D + 1) - 1;
  Setting<D, R> drained{octant, with_planes}, cut{octant, with_planes};
  Setting<D, R> whole{test::ball_body<D>(2.2, 0.8), 0b1};
  drained.odd.pairs = {{D, 0}};
  cut.odd.pairs = {{0, 0}, {D, 0}, {1, R - 1}};
  return {free, sealed, mixed, held, drained, cut, whole};
}

template <int D, int R>
void expect_linear_fields_exact(Cloud cloud) {
  const auto body = test::box_body<D>(test::cube<D>(5), 0.8, cloud);
  // A field even at the low x face and odd about 0.3 at the high y face: it may depend on y only.
  for (const bool faces : {false, true}) {
    Setting<D, R> setting{body, faces ? 0b1001u : 0u};
    const double height = 5 * 0.8;
    Tensor<R, D> slope{};
    for (int k = 0; k < R * D; ++k) {
      if (!faces || k % D != 0) slope[k] = 0.7 - 0.4 * k;
    }
    std::vector<double> origin(R);
    for (int r = 0; r < R; ++r) origin[r] = 0.2 * r - 1.0;
    if (faces) {
      for (int r = 0; r < R; ++r) {
        setting.odd.pairs.push_back({3, r});
        if (D == 3) slope[r * D + 2] = 0.0;
      }
    }
    auto op = setting.make();
    std::vector<double> u(op.size());
    const Points<D>& points = body->points();
    for (int r = 0; r < R; ++r) {
      for (Index i = 0; i < points.size(); ++i) {
        double value = origin[r];
        for (int b = 0; b < D; ++b) value += slope[r * D + b] * points.position[b][i];
        u[r * points.size() + i] = value;
      }
      if (faces) u[R * points.size() + r] = origin[r] + slope[r * D + 1] * height;
    }
    std::vector<double> gradient(R * D * points.size());
    op.gradient(u, gradient);
    for (int k = 0; k < R * D; ++k) {
      for (Index i = 0; i < points.size(); ++i) {
        ASSERT_NEAR(gradient[k * points.size() + i], slope[k], 1e-12);
      }
    }
    // No stabilisation: the force is that of the stress alone, A u = G^T V C : slope.
    const AnyLaw<R, D> law;
    const Tensor<R, D> stress = law.stress(slope);
    Eigen::VectorXd flux(R * D * points.size());
    for (int k = 0; k < R * D; ++k) {
      for (Index i = 0; i < points.size(); ++i) {
        flux[k * points.size() + i] = points.volume[i] * stress[k];
      }
    }
    const Eigen::VectorXd expected = op.gradient_matrix().transpose() * flux;
    std::vector<double> force(op.size());
    op.apply(u, force);
    EXPECT_LT(test::largest(test::as_eigen(force) - expected), 1e-12 * test::largest(expected));
  }
}

TEST(LinearExactOperator, IsExactForLinearFieldsSurfacesIncluded) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_linear_fields_exact<2, 1>(cloud);
    expect_linear_fields_exact<2, 2>(cloud);
    expect_linear_fields_exact<3, 1>(cloud);
    expect_linear_fields_exact<3, 3>(cloud);
  }
}

template <int D, int R>
void expect_force_is_the_energys_derivative(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D, R>& setting : settings<D, R>(count, cloud)) {
      auto op = setting.make();
      const Points<D>& points = setting.body->points();
      const auto nodes = test::all_images<D>(points, setting.body->faces(), setting.mirrored);
      const auto energy = [&](const std::vector<double>& u) {
        return test::brute_force_energy<D, R>(points, nodes, setting.odd, AnyLaw<R, D>{},
                                              setting.body->horizon(), u);
      };
      const std::vector<double> u = test::random_values(op.size());
      std::vector<double> force(op.size());
      op.apply(u, force);
      const double e = energy(u);
      EXPECT_NEAR(0.5 * test::as_eigen(u).dot(test::as_eigen(force)), e, 1e-12 * e);
      // The energy is quadratic: a central difference of any width is exact but for rounding.
      std::vector<Index> checked(setting.odd.pairs.size());
      std::iota(checked.begin(), checked.end(), R * points.size());
      for (Index k = 0; k < op.point_unknowns(); k += op.point_unknowns() / 11) {
        checked.push_back(k);
      }
      for (const Index k : checked) {
        std::vector<double> up = u, down = u;
        up[k] += 0.5;
        down[k] -= 0.5;
        ASSERT_NEAR(force[k], energy(up) - energy(down), 1e-11 * e) << "unknown " << k;
      }
    }
  }
}

TEST(LinearExactOperator, IsTheDerivativeOfItsEnergyIn2D) {
  expect_force_is_the_energys_derivative<2, 1>(6);
  expect_force_is_the_energys_derivative<2, 2>(6);
}

TEST(LinearExactOperator, IsTheDerivativeOfItsEnergyIn3D) {
  expect_force_is_the_energys_derivative<3, 1>(4);
  expect_force_is_the_energys_derivative<3, 3>(4);
}

template <int D, int R>
void expect_matrix_is_the_operator(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D, R>& setting : settings<D, R>(count, cloud)) {
      auto op = setting.make();
      const Eigen::SparseMatrix<double> a = op.assemble();
      ASSERT_EQ(a.rows(), op.size());
      const Eigen::SparseMatrix<double> difference = a - Eigen::SparseMatrix<double>(a.transpose());
      const double scale = a.diagonal().maxCoeff();
      EXPECT_LT(difference.coeffs().abs().maxCoeff(), 1e-13 * scale) << "symmetry";

      const std::vector<double> u = test::random_values(op.size());
      std::vector<double> force(op.size());
      op.apply(u, force);
      EXPECT_LT(test::largest(a * test::as_eigen(u) - test::as_eigen(force)), 1e-12 * scale);

      std::vector<double> gradient(R * D * setting.body->points().volume.size());
      op.gradient(u, gradient);
      EXPECT_LT(test::largest(op.gradient_matrix() * test::as_eigen(u) - test::as_eigen(gradient)),
                1e-12);
    }
  }
}

TEST(LinearExactOperator, AssemblesTheMatrixThatItApplies) {
  expect_matrix_is_the_operator<2, 1>(6);
  expect_matrix_is_the_operator<2, 2>(6);
  expect_matrix_is_the_operator<3, 1>(4);
  expect_matrix_is_the_operator<3, 3>(4);
}

template <int D, int R>
void expect_uniform_fields_to_be_free(int count) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const Setting<D, R>& setting : settings<D, R>(count, cloud)) {
      // Forces add up to nothing, reactions included, whatever the field: 1^T A u = 0.
      auto op = setting.make();
      const std::vector<double> u = test::random_values(op.size());
      std::vector<double> force(op.size());
      op.apply(u, force);
      const Index points = setting.body->points().size();
      for (int r = 0; r < R; ++r) {
        double sum =
            std::accumulate(force.begin() + r * points, force.begin() + (r + 1) * points, 0.0);
        for (std::size_t k = 0; k < setting.odd.pairs.size(); ++k) {
          if (setting.odd.pairs[k].component == r) sum += force[R * points + k];
        }
        EXPECT_NEAR(sum, 0.0, 1e-12 * test::largest(force));
      }
    }
  }
}

TEST(LinearExactOperator, KeepsWhatItMoves) {
  expect_uniform_fields_to_be_free<2, 1>(8);
  expect_uniform_fields_to_be_free<2, 2>(8);
  expect_uniform_fields_to_be_free<3, 1>(5);
  expect_uniform_fields_to_be_free<3, 3>(5);
}

template <int D, int R>
void expect_same_bits(const std::array<int, D>& counts) {
  Setting<D, R> setting{test::box_body<D>(counts, 1.0, Cloud::jittered), 0b0110};
  setting.odd.pairs = {{1, 0}, {2, R - 1}};
  auto op = setting.make();
  ASSERT_GE(setting.body->points().size(), points_worth_threads);
  const std::vector<double> u = test::random_values(op.size());
  const int threads = omp_get_max_threads();
  std::vector<std::vector<double>> forces;
  for (const int n : {1, 2, 3}) {
    omp_set_num_threads(n);
    forces.emplace_back(op.size());
    op.apply(u, forces.back());
  }
  omp_set_num_threads(threads);
  EXPECT_EQ(forces[0], forces[1]);
  EXPECT_EQ(forces[0], forces[2]);
}

TEST(LinearExactOperator, TakesNoAddedStressBesideCurvedGhosts) {
  auto op = Setting<2, 2>{test::ball_body<2>(4.0, 1.0), 0b1}.make();
  std::vector<double> u(op.size()), force(op.size());
  EXPECT_THROW(op.apply(u, force, [](Index, const auto&, auto&) {}), std::logic_error);
}

TEST(LinearExactOperator, GivesTheSameBitsAtAnyThreadCount) {
  expect_same_bits<2, 1>({95, 90});
  expect_same_bits<2, 2>({95, 90});
  expect_same_bits<3, 3>({21, 20, 20});
}

}  // namespace
}  // namespace perifrac
