#include <cmath>

#include <Eigen/IterativeLinearSolvers>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/solvers/sparse_cholesky.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "tests/unit/pore_flow/pore_body.hpp"

namespace perifrac {
namespace {

using test::Cloud;
using test::name_of;

/// A flow of unit mobility; faces in `pressures` have a face value, the other mirrored are sealed.
template <int D>
std::unique_ptr<FlowOperator<D>> flow(FlowScheme scheme, const Body<D>& body, FaceSet mirrored,
                                      FaceSet pressures = 0) {
  const auto family = body.family(mirrored);
  MirrorCondition<D, 1> mirror(*family);
  for (int face = 0; face < 2 * D; ++face) {
    if (contains(pressures, face)) mirror.set_odd(face, 0);
  }
  return make_flow(scheme, LinearExactOperator<D, DarcyLaw<D>>(family, mirror, DarcyLaw<D>{1.0}));
}

template <int D>
double phase(const Vector<D>& x) {
  constexpr Vector<3> wave = {2.0, 1.4, 0.9};
  double sum = 0.3;
  for (int a = 0; a < D; ++a) sum += wave[a] * x[a];
  return sum;
}

/// Outflow of a field, per volume; no face values.
template <int D, class Field>
std::vector<double> outflow_of(FlowOperator<D>& flow, const Points<D>& points, Field&& field) {
  std::vector<double> p(flow.size()), outflow(flow.size());
  for (Index i = 0; i < points.size(); ++i) p[i] = field(points.at(i));
  flow.apply(p, outflow);
  for (Index i = 0; i < points.size(); ++i) outflow[i] /= points.volume[i];
  return outflow;
}

/// More than `depth` away from all faces.
template <int D>
bool inside(const Body<D>& body, Index i, double depth) {
  return std::ranges::all_of(body.faces(), [&](const Face& face) {
    return face.direction * (face.coordinate - body.points().position[face.axis][i]) > depth;
  });
}

template <int D>
void expect_matrix_of_what_is_applied(FlowScheme scheme) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = test::box_body<D>(test::cube<D>(7), 0.5, cloud);
    // Faces that are cut, sealed and of prescribed pressure, with corners of each kind.
    const auto of = flow<D>(scheme, *body, D == 2 ? 0b1110 : 0b111101, D == 2 ? 0b1010 : 0b010100);
    const auto p = test::random_values(of->size());
    std::vector<double> outflow(of->size());
    of->apply(p, outflow);
    const Eigen::VectorXd difference = of->assemble() * test::as_eigen(p) - test::as_eigen(outflow);
    EXPECT_LT(test::largest(difference), 1e-13 * test::largest(outflow)) << name_of(scheme);
  }
}

TEST(FlowOperators, ApplyTheMatrixThatTheyAssemble) {
  for (const FlowScheme scheme : test::schemes) {
    expect_matrix_of_what_is_applied<2>(scheme);
    expect_matrix_of_what_is_applied<3>(scheme);
  }
}

template <int D>
void expect_exact_for_linear_fields(FlowScheme scheme) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    const auto body = test::box_body<D>(test::cube<D>(D == 2 ? 16 : 12), 0.5, cloud);
    const auto of = flow<D>(scheme, *body, 0);
    const Index n = body->points().size();
    std::vector<double> p(n), velocity(D * n);
    for (Index i = 0; i < n; ++i) p[i] = phase<D>(body->points().at(i));
    of->velocity(p, velocity);
    for (Index i = 0; i < n; ++i) {
      EXPECT_NEAR(velocity[i], -2.0, 1e-12) << name_of(scheme);
      EXPECT_NEAR(velocity[n + i], -1.4, 1e-12) << name_of(scheme);
    }
    // Bond fluxes balance where all families about are whole and alike.
    if (cloud == Cloud::jittered && scheme != FlowScheme::nested) continue;
    const auto outflow = outflow_of<D>(*of, body->points(), phase<D>);
    for (Index i = 0; i < n; ++i) {
      const bool whole = scheme == FlowScheme::nested || inside(*body, i, 2.0 * body->horizon());
      if (whole) {
        EXPECT_NEAR(outflow[i], 0.0, 1e-11) << name_of(scheme);
      }
    }
  }
}

TEST(FlowOperators, AreExactForLinearFields) {
  for (const FlowScheme scheme : test::schemes) {
    expect_exact_for_linear_fields<2>(scheme);
    expect_exact_for_linear_fields<3>(scheme);
  }
}

/// Symmetric, no energy is made, and uniform pressure alone is at rest.
template <int D>
void expect_one_null_mode(FlowScheme scheme, const Body<D>& body, FaceSet mirrored) {
  const Eigen::MatrixXd h = flow<D>(scheme, body, mirrored)->assemble();
  const Eigen::VectorXd values = symmetric_spectrum(h).values;
  const double top = values[values.size() - 1];
  EXPECT_LT((h - h.transpose()).cwiseAbs().maxCoeff(), 1e-14 * top) << name_of(scheme);
  EXPECT_LT(std::abs(values[0]), 1e-13 * top) << name_of(scheme);
  EXPECT_GT(values[1], 1e-3 * top) << name_of(scheme);
  ::testing::Test::RecordProperty(
      fmt::format("{}_{}D_{}_points_mirrored_{}", name_of(scheme), D, body.points().size(),
                  mirrored),
      fmt::format("null {:.1e}, next {:.1e}", std::abs(values[0]) / top, values[1] / top));
}

TEST(FlowOperators, HaveOnlyUniformPressureAsNullMode) {
  for (const FlowScheme scheme : {FlowScheme::conservative, FlowScheme::bond}) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      for (const FaceSet mirrored : {0b0000u, 0b1111u}) {
        expect_one_null_mode<2>(scheme, *test::box_body<2>({8, 7}, 0.5, cloud), mirrored);
      }
      for (const FaceSet mirrored : {0b000000u, 0b111111u}) {
        expect_one_null_mode<3>(scheme, *test::box_body<3>({5, 4, 6}, 0.5, cloud), mirrored);
      }
    }
    expect_one_null_mode<2>(scheme, *test::ball_body<2>(4.2, 1.0), 0);
    expect_one_null_mode<3>(scheme, *test::ball_body<3>(3.1, 1.0), 0);
  }
}

/// What leaves the points leaves through faces, for any pressures: columns sum to nothing.
template <int D>
double lost_mass(FlowScheme scheme, Cloud cloud, FaceSet mirrored, FaceSet pressures) {
  const auto body = test::box_body<D>(test::cube<D>(7), 0.5, cloud);
  const Eigen::MatrixXd h = flow<D>(scheme, *body, mirrored, pressures)->assemble();
  return h.colwise().sum().cwiseAbs().maxCoeff() / h.cwiseAbs().maxCoeff();
}

TEST(FlowOperators, KeepMass) {
  for (const FlowScheme scheme : {FlowScheme::conservative, FlowScheme::bond}) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      EXPECT_LT(lost_mass<2>(scheme, cloud, 0b1110, 0b1010), 1e-13) << name_of(scheme);
      EXPECT_LT(lost_mass<3>(scheme, cloud, 0b111101, 0b010100), 1e-13) << name_of(scheme);
    }
  }
  // Only where all families are alike.
  EXPECT_LT(lost_mass<2>(FlowScheme::nested, Cloud::lattice, 0b1111, 0b1010), 1e-13);
  EXPECT_LT(lost_mass<3>(FlowScheme::nested, Cloud::lattice, 0b111111, 0b010100), 1e-13);
  EXPECT_GT(lost_mass<2>(FlowScheme::nested, Cloud::lattice, 0b1110, 0b1010), 0.1);
  EXPECT_GT(lost_mass<2>(FlowScheme::nested, Cloud::jittered, 0b1111, 0b1010), 0.01);
}

template <class Values>
void expect_order(const std::string& name, const Values& sizes, const std::vector<double>& errors,
                  double least, double most = 9.0) {
  std::string record;
  for (std::size_t k = 1; k < errors.size(); ++k) {
    const double order = std::log(errors[k - 1] / errors[k]) /
                         std::log(static_cast<double>(sizes[k]) / sizes[k - 1]);
    record += fmt::format("{:.3f} ", order);
    EXPECT_GE(order, least) << name;
    EXPECT_LE(order, most) << name;
  }
  ::testing::Test::RecordProperty(name, record + fmt::format("last error {:.2e}", errors.back()));
}

/// H p / V against -kappa Laplace(p) well inside, of a wave that runs along no axis.
template <int D>
void expect_order_inside(FlowScheme scheme, const std::vector<int>& counts, double least) {
  std::vector<double> errors;
  for (const int count : counts) {
    const auto body = test::box_body<D>(test::cube<D>(count), 1.0 / count);
    const auto wave = [](const Vector<D>& x) { return std::sin(phase<D>(x)); };
    const auto outflow = outflow_of<D>(*flow<D>(scheme, *body, 0), body->points(), wave);
    const double wave2 = D == 2 ? 2.0 * 2.0 + 1.4 * 1.4 : 2.0 * 2.0 + 1.4 * 1.4 + 0.9 * 0.9;
    double worst = 0.0;
    for (Index i = 0; i < body->points().size(); ++i) {
      if (!inside(*body, i, 0.3)) continue;
      worst = std::max(worst, std::abs(outflow[i] - wave2 * wave(body->points().at(i))));
    }
    errors.push_back(worst);
  }
  expect_order(fmt::format("order_inside_{}_{}D", name_of(scheme), D), counts, errors, least);
}

TEST(FlowOperators, ConvergeInside) {
  for (const FlowScheme scheme : test::schemes) {
    const double least = scheme == FlowScheme::conservative ? 3.8 : 1.9;
    expect_order_inside<2>(scheme, {20, 40, 80}, least);
    expect_order_inside<3>(scheme, {18, 26, 36}, least);
  }
}

/// Steady diffusion with uptake, p - Laplace(p) = q between sealed faces, of p = g(x), times g(y)
/// in 2D, with g = 3 x^2 - 2 x^3 + 1: flat at the faces, but no even function about them. In 3D the
/// body is a bar, because the order shows on fine lattices only.
template <int D>
std::vector<double> errors_with_sealed_faces(FlowScheme scheme, const std::vector<int>& counts,
                                             bool ghosts) {
  std::vector<double> errors;
  for (const int count : counts) {
    const std::array<int, 3> bar = {count, 6, 6};
    std::array<int, D> size;
    for (int a = 0; a < D; ++a) size[a] = D == 2 ? count : bar[a];
    const auto body = test::box_body<D>(size, 1.0 / count);
    const Points<D>& points = body->points();
    Eigen::VectorXd exact(points.size()), right_side(points.size());
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
        flow<D>(scheme, *body, ghosts ? face_bit(2 * D) - 1 : 0)->assemble();
    for (Index i = 0; i < points.size(); ++i) matrix.coeffRef(i, i) += points.volume[i];
    Eigen::VectorXd p(points.size());
    if (scheme == FlowScheme::nested) {
      Eigen::BiCGSTAB<Eigen::SparseMatrix<double>> solver(matrix);  // not symmetric
      solver.setTolerance(1e-12);
      p = solver.solve(right_side);
      EXPECT_EQ(solver.info(), Eigen::Success);
    } else {
      SparseCholesky factor;
      factor.factor(matrix);
      factor.solve(right_side, p);
    }
    errors.push_back(test::largest(p - exact));
  }
  return errors;
}

template <int D>
void expect_order_between_sealed_faces(FlowScheme scheme, const std::vector<int>& counts,
                                       bool ghosts, double least, double most = 9.0) {
  expect_order(
      fmt::format("order_sealed_{}_{}D_{}", name_of(scheme), D, ghosts ? "mirrored" : "natural"),
      counts, errors_with_sealed_faces<D>(scheme, counts, ghosts), least, most);
}

TEST(FlowOperators, ConvergeAtSealedFaces) {
  for (const FlowScheme scheme : {FlowScheme::conservative, FlowScheme::bond}) {
    expect_order_between_sealed_faces<2>(scheme, {24, 48, 96}, true, 1.9);
    expect_order_between_sealed_faces<3>(scheme, {32, 64, 128}, true, 1.9);
  }
  expect_order_between_sealed_faces<2>(FlowScheme::nested, {16, 32}, true, 1.9);
  expect_order_between_sealed_faces<2>(FlowScheme::conservative, {24, 48, 96}, false, 1.9);
  expect_order_between_sealed_faces<3>(FlowScheme::conservative, {32, 64, 128}, false, 1.9);
  // One flux a bond does not balance a linear pressure where families are cut.
  expect_order_between_sealed_faces<2>(FlowScheme::bond, {24, 48, 96}, false, 0.9, 1.2);
}

/// Stored energy falls in every window of a closed box, whatever the pressures.
TEST(FlowOperators, LoseEnergy) {
  for (const FlowScheme scheme : {FlowScheme::conservative, FlowScheme::bond}) {
    for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
      const auto body = test::box_body<2>({12, 9}, 0.5, cloud);
      const PoreBoundary<2> closed(*body);
      auto system = test::darcy_system<2>(*body, closed, test::some_rock, scheme);
      ForwardEuler euler(system, 0.9);
      std::vector<double> y = test::random_values(system.size());
      euler.reset(0.0, y);
      const double step = 0.9 * euler.stable_step();
      double before = INFINITY;
      for (int n = 1; n <= 200; ++n) {
        euler.advance(n * step, y);
        double energy = 0.0;
        for (Index i = 0; i < system.points(); ++i) energy += system.volume()[i] * y[i] * y[i];
        EXPECT_LT(energy, before) << name_of(scheme) << ", step " << n;
        before = energy;
      }
    }
  }
}

}  // namespace
}  // namespace perifrac
