#include "modules/pore_flow/darcy_law.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/operators/linear_exact.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using std::numbers::pi;
using test::Cloud;

template <int D>
LinearExactOperator<D, DarcyLaw<D>> sealed_flow(const Body<D>& body, FaceSet mirrored) {
  const auto family = body.family(mirrored);
  return {family, MirrorCondition<D, 1>(*family), DarcyLaw<D>{1.0}};
}

template <int D>
void expect_one_null_mode(const Body<D>& body, FaceSet mirrored) {
  const Eigen::MatrixXd h = sealed_flow<D>(body, mirrored).assemble();
  const Eigen::VectorXd values = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(h).eigenvalues();
  const double top = values[values.size() - 1];
  EXPECT_LT(std::abs(values[0]), 1e-13 * top);
  EXPECT_GT(values[1], 1e-3 * top);
  ::testing::Test::RecordProperty(
      fmt::format("{}D_{}_points_mirrored_{}", D, body.points().size(), mirrored),
      fmt::format("null {:.1e}, next {:.1e}", std::abs(values[0]) / top, values[1] / top));
}

TEST(FlowOperator, HasOnlyUniformPressureAsNullMode) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    for (const FaceSet mirrored : {0b0000u, 0b1111u}) {
      expect_one_null_mode<2>(*test::box_body<2>({8, 7}, 0.5, cloud), mirrored);
    }
    for (const FaceSet mirrored : {0b000000u, 0b111111u}) {
      expect_one_null_mode<3>(*test::box_body<3>({5, 4, 6}, 0.5, cloud), mirrored);
    }
  }
  expect_one_null_mode<2>(*test::ball_body<2>(4.2, 1.0), 0);
  expect_one_null_mode<3>(*test::ball_body<3>(3.1, 1.0), 0);
}

template <class Values>
void expect_order(const std::string& name, const Values& sizes, const std::vector<double>& errors,
                  double least) {
  std::string record;
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double order = std::log(errors[k - 1] / errors[k]) /
                         std::log(static_cast<double>(sizes[k]) / sizes[k - 1]);
    record += fmt::format("{:.3f} ", order);
    EXPECT_GE(order, least) << name;
  }
  ::testing::Test::RecordProperty(name, record + fmt::format("last error {:.2e}", errors.back()));
}

/// H p / V against -kappa Laplace(p) at points more than two horizons inside, of a wave that runs
/// along no axis.
template <int D>
void expect_fourth_order_inside(const std::vector<int>& counts) {
  const Vector<3> wave = {2.0, 1.4, 0.9};
  std::vector<double> errors;
  for (const int count : counts) {
    const auto body = test::box_body<D>(test::cube<D>(count), 1.0 / count);
    auto flow = sealed_flow<D>(*body, 0);
    const Points<D>& points = body->points();
    std::vector<double> p(flow.size()), outflow(flow.size());
    double wave2 = 0.0;
    for (int a = 0; a < D; ++a) wave2 += wave[a] * wave[a];
    for (Index i = 0; i < points.size(); ++i) {
      double phase = 0.3;
      for (int a = 0; a < D; ++a) phase += wave[a] * points.position[a][i];
      p[i] = std::sin(phase);
    }
    flow.apply(p, outflow);
    double worst = 0.0;
    for (Index i = 0; i < points.size(); ++i) {
      bool inside = true;
      for (int a = 0; a < D; ++a) inside = inside && std::abs(points.position[a][i] - 0.5) < 0.2;
      if (inside) worst = std::max(worst, std::abs(outflow[i] / points.volume[i] - wave2 * p[i]));
    }
    errors.push_back(worst);
  }
  expect_order(fmt::format("order_inside_{}D", D), counts, errors, 3.8);
}

TEST(FlowOperator, IsOfFourthOrderInside) {
  expect_fourth_order_inside<2>({20, 40, 80});
  expect_fourth_order_inside<3>({18, 26, 36});
}

/// Steady diffusion with uptake, p - Laplace(p) = q between sealed faces, of p = g(x), times g(y)
/// in 2D, with g = 3 x^2 - 2 x^3 + 1: flat at the faces, but no even function about them. In 3D the
/// body is a bar, because the order shows on fine lattices only.
template <int D>
std::vector<double> errors_with_sealed_faces(const std::vector<int>& counts, bool ghosts) {
  std::vector<double> errors;
  for (const int count : counts) {
    const std::array<int, 3> bar = {count, 6, 6};
    std::array<int, D> size;
    for (int a = 0; a < D; ++a) size[a] = D == 2 ? count : bar[a];
    const auto body = test::box_body<D>(size, 1.0 / count);
    const Points<D>& points = body->points();
    Eigen::VectorXd exact(points.size()), right_side(points.size()), p(points.size());
    for (Index i = 0; i < points.size(); ++i) {
      double product = 1.0, curvature = 0.0;  // Laplace(p) / p
      for (int a = 0; a < (D == 2 ? 2 : 1); ++a) {
        const double x = points.position[a][i];
        const double g = x * x * (3.0 - 2.0 * x) + 1.0;
        product *= g;
        curvature += (6.0 - 12.0 * x) / g;
      }
      exact[i] = product;
      right_side[i] = points.volume[i] * product * (1.0 - curvature);
    }
    Eigen::SparseMatrix<double> matrix =
        sealed_flow<D>(*body, ghosts ? face_bit(2 * D) - 1 : 0).assemble();
    for (Index i = 0; i < points.size(); ++i) matrix.coeffRef(i, i) += points.volume[i];
    SparseCholesky factor;
    factor.factor(matrix);
    factor.solve(right_side, p);
    errors.push_back(test::largest(p - exact));
  }
  return errors;
}

template <int D>
void expect_second_order_between_sealed_faces(const std::vector<int>& counts) {
  for (const bool ghosts : {true, false}) {
    expect_order(fmt::format("order_sealed_{}D_{}", D, ghosts ? "mirrored" : "natural"), counts,
                 errors_with_sealed_faces<D>(counts, ghosts), 1.9);
  }
}

TEST(FlowOperator, IsOfSecondOrderAtSealedFaces) {
  expect_second_order_between_sealed_faces<2>({24, 48, 96});
  expect_second_order_between_sealed_faces<3>({32, 64, 128});
}

}  // namespace
}  // namespace perifrac
