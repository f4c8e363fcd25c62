#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/operators/linear_exact.hpp"
#include "core/solvers/symmetric_spectrum.hpp"
#include "modules/pore_flow/flux/conservative_flow.hpp"
#include "modules/pore_flow/material/darcy_law.hpp"
#include "tests/orthonormal.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

/// Principal values 1 and 0.1 (and 0.4), along no axis.
template <int D>
AnisotropicDarcyLaw<D> some_law() {
  Eigen::Matrix<double, D, D> axes;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) axes(a, b) = std::sin(1.0 + 3.0 * a + 1.7 * b + a * b);
  }
  const Eigen::Matrix<double, D, D> q = test::orthonormal<D>(axes);
  Eigen::Matrix<double, D, 1> values;
  for (int a = 0; a < D; ++a) values[a] = std::array{1.0, 0.1, 0.4}[a];
  const Eigen::Matrix<double, D, D> tensor = q * values.asDiagonal() * q.transpose();
  AnisotropicDarcyLaw<D> law;
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) law.mobility[a * D + b] = 0.5 * (tensor(a, b) + tensor(b, a));
  }
  return law;
}

template <int D, class Law>
LinearExactOperator<D, Law> flow_of(const Body<D>& body, Law law, FaceSet mirrored = 0) {
  const auto family = body.family(mirrored);
  return {family, MirrorCondition<D, 1>(*family), std::move(law)};
}

TEST(AnisotropicDarcyLaw, IsTheIsotropicOneWhereItsValuesAgree) {
  const AnisotropicDarcyLaw<3> law{{0.7, 0, 0, 0, 0.7, 0, 0, 0, 0.7}};
  const DarcyLaw<3> isotropic{0.7};
  EXPECT_NEAR(law.stabilisation(), isotropic.stabilisation(), 1e-15);
  EXPECT_NEAR(law.mean_mobility(), isotropic.mean_mobility(), 1e-15);
  const Tensor<1, 3> gradient = {0.3, -0.2, 0.9};
  for (int a = 0; a < 3; ++a) {
    EXPECT_NEAR(law.stress(gradient)[a], isotropic.stress(gradient)[a], 1e-15);
  }
}

template <int D>
void expect_exact_for_linear_pressure(Cloud cloud) {
  const auto body = test::box_body<D>(test::cube<D>(D == 2 ? 14 : 12), 0.5, cloud);
  const auto law = some_law<D>();
  ConservativeFlow<D, AnisotropicDarcyLaw<D>> flow(flow_of<D>(*body, law));
  const Points<D>& points = body->points();
  const Tensor<1, D> gradient = [] {
    Tensor<1, D> g;
    for (int a = 0; a < D; ++a) g[a] = 0.4 - 0.5 * a;
    return g;
  }();
  std::vector<double> p(flow.size()), outflow(flow.size()), velocity(D * flow.size());
  for (Index i = 0; i < points.size(); ++i) {
    for (int a = 0; a < D; ++a) p[i] += gradient[a] * points.position[a][i];
  }
  flow.apply(p, outflow);
  flow.velocity(p, velocity);
  const double size = D == 2 ? 7.0 : 6.0;
  const Tensor<1, D> flux = law.stress(gradient);
  for (Index i = 0; i < points.size(); ++i) {
    bool inside = true;
    for (int a = 0; a < D; ++a) {
      EXPECT_NEAR(velocity[a * points.size() + i], -flux[a], 1e-13);
      inside = inside && std::abs(points.position[a][i] - 0.5 * size) < 0.5 * size - 2.6;
    }
    // On a lattice, a uniform flux leaves nothing behind but at the surface.
    if (inside && cloud == Cloud::lattice) {
      EXPECT_NEAR(outflow[i], 0.0, 1e-13);
    }
  }
}

TEST(AnisotropicDarcyLaw, IsExactForLinearPressure) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_exact_for_linear_pressure<2>(cloud);
    expect_exact_for_linear_pressure<3>(cloud);
  }
}

template <int D>
void expect_symmetric_with_one_null_mode(const Body<D>& body) {
  const Eigen::MatrixXd h = flow_of<D>(body, some_law<D>()).assemble();
  const double top = h.cwiseAbs().maxCoeff();
  EXPECT_LT((h - h.transpose()).cwiseAbs().maxCoeff(), 1e-14 * top);
  EXPECT_LT(h.colwise().sum().cwiseAbs().maxCoeff(), 1e-13 * top) << "fluid is lost";
  const Eigen::VectorXd values = symmetric_spectrum(h).values;
  EXPECT_LT(std::abs(values[0]), 1e-13 * values[values.size() - 1]);
  EXPECT_GT(values[1], 1e-4 * values[values.size() - 1]);
}

TEST(AnisotropicDarcyLaw, LosesNothingAndHasOneNullMode) {
  expect_symmetric_with_one_null_mode<2>(*test::box_body<2>({9, 8}, 0.5, Cloud::jittered));
  expect_symmetric_with_one_null_mode<3>(*test::box_body<3>({5, 4, 6}, 0.5, Cloud::jittered));
}

/// H p / V of a wave against its exact k.K.k p, more than two horizons inside.
template <int D>
void expect_second_order_inside(const std::vector<int>& counts) {
  const Vector<3> wave = {2.0, 1.4, 0.9};
  const auto law = some_law<D>();
  Tensor<1, D> k;
  for (int a = 0; a < D; ++a) k[a] = wave[a];
  double exact = 0.0;
  for (int a = 0; a < D; ++a) exact += k[a] * law.stress(k)[a];
  std::vector<double> errors;
  for (const int count : counts) {
    const auto body = test::box_body<D>(test::cube<D>(count), 1.0 / count);
    auto flow = flow_of<D>(*body, law);
    const Points<D>& points = body->points();
    std::vector<double> p(flow.size()), outflow(flow.size());
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
      if (inside) worst = std::max(worst, std::abs(outflow[i] / points.volume[i] - exact * p[i]));
    }
    errors.push_back(worst / exact);
  }
  for (std::size_t n = 1; n < errors.size(); ++n) {
    const double order = std::log(errors[n - 1] / errors[n]) /
                         std::log(static_cast<double>(counts[n]) / counts[n - 1]);
    EXPECT_GE(order, 1.9) << errors[n];
    ::testing::Test::RecordProperty(fmt::format("order_{}D_{}", D, counts[n]),
                                    fmt::format("{:.2f}, error {:.2e}", order, errors[n]));
  }
}

TEST(AnisotropicDarcyLaw, IsOfSecondOrderInside) {
  expect_second_order_inside<2>({20, 40, 80});
  expect_second_order_inside<3>({18, 26, 36});
}

TEST(AnisotropicDarcyLaw, ScalesAsTheSameFactorsOnItsEntriesWould) {
  const auto body = test::box_body<2>({9, 8}, 0.5, Cloud::jittered);
  const Index n = body->points().size();
  const std::vector<std::uint8_t> region(n, 0);
  const std::vector<double> ones(n, 1.0);
  std::vector<double> factor = test::random_values(n, 3);
  for (double& f : factor) f = 1.0 + 0.5 * f;
  const LawByRegion<AnisotropicDarcyLaw<2>> law{{some_law<2>()}, region};
  ConservativeFlow<2, ScaledDarcyLaw<2>> scaled(flow_of<2>(*body, ScaledDarcyLaw<2>{law, ones}));
  scaled.scale_mobility(factor);
  std::vector<std::uint8_t> own(n);
  LawByRegion<AnisotropicDarcyLaw<2>> by_point;
  for (Index i = 0; i < n; ++i) {
    own[i] = static_cast<std::uint8_t>(i);
    by_point.laws.push_back(some_law<2>().times(factor[i]));
  }
  by_point.law_of_point = own;
  ConservativeFlow<2, LawByRegion<AnisotropicDarcyLaw<2>>> expected(flow_of<2>(*body, by_point));
  const auto p = test::random_values(n);
  std::vector<double> found(n), wanted(n);
  scaled.apply(p, found);
  expected.apply(p, wanted);
  for (Index i = 0; i < n; ++i) EXPECT_NEAR(found[i], wanted[i], 1e-13);
  const Eigen::MatrixXd difference = scaled.assemble() - expected.assemble();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace perifrac
