#include "core/time/spectral_radius.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "core/base/eigen_view.hpp"
#include "core/base/errors.hpp"
#include "tests/spectra.hpp"

namespace perifrac {
namespace {

/// Of [[0, -b], [a, 0]], whose eigenvalues are +- i sqrt(a b): a vector grows by a and by b in
/// turn.
double radius_of_pair(double a, double b) {
  return spectral_radius("field", 0.0, 2, 2,
                         [=](std::span<const double> v, std::span<double> product) {
                           product[0] = -b * v[1];
                           product[1] = a * v[0];
                         });
}

TEST(SpectralRadius, BoundsAPairOfComplexEigenvalues) {
  for (const auto& [a, b] : {std::array{1.0, 4.0}, std::array{2.0, 2.0}, std::array{9.0, 1.0}}) {
    EXPECT_GE(radius_of_pair(a, b), std::sqrt(a * b));
    EXPECT_LE(radius_of_pair(a, b), 1.03 * std::max(a, b));
  }
}

/// Of a chain whose ends are held, K, and masses that lean on their neighbours, M: the fastest mode
/// is the one that alternates, where M has its smallest value too.
TEST(SpectralRadius, BoundsAPairOfSymmetricMatrices) {
  constexpr int size = 60;
  Eigen::MatrixXd k = 2.0 * Eigen::MatrixXd::Identity(size, size);
  k.diagonal(1).setConstant(-1.0);
  k.diagonal(-1).setConstant(-1.0);
  const Eigen::MatrixXd m =
      Eigen::MatrixXd::Identity(size, size) - 0.15 * (k - 2.0 * k.Identity(size, size));
  const Eigen::LLT<Eigen::MatrixXd> factor(m);
  const double bound = symmetric_spectral_radius(
      "field", 0.0, size,
      [&](std::span<const double> v, std::span<double> product) { view(product) = k * view(v); },
      [&](std::span<const double> mv, std::span<double> v) { view(v) = factor.solve(view(mv)); });
  const double largest = test::symmetric_spectrum(k, m).values.maxCoeff();
  EXPECT_GT(bound, largest);
  EXPECT_LT(bound, 1.1 * largest);
}

TEST(SpectralRadius, SaysWhereItIsNotFound) {
  EXPECT_THROW(radius_of_pair(std::numeric_limits<double>::infinity(), 1.0), NumericalError);
}

}  // namespace
}  // namespace perifrac
