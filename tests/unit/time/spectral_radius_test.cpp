#include "core/time/spectral_radius.hpp"

#include <array>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/errors.hpp"

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

TEST(SpectralRadius, SaysWhereItIsNotFound) {
  EXPECT_THROW(radius_of_pair(std::numeric_limits<double>::infinity(), 1.0), NumericalError);
}

}  // namespace
}  // namespace perifrac
