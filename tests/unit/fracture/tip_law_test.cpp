#include "modules/solid/fracture/tip_law.hpp"

#include <cmath>

#include <gtest/gtest.h>

namespace perifrac {
namespace {

constexpr TipLaw granite{7.5e8, 5.0};
constexpr TipFluid water{1e-3, 0.0};
constexpr double s = 4e-3, speed = 0.5;

double toughness_asymptote(const TipLaw& law) {
  return std::sqrt(32.0 / M_PI * s * law.fracture_energy / law.plane_strain_modulus);
}
double viscosity_asymptote(const TipFluid& fluid) {
  const double mu = 12.0 * fluid.viscosity;
  return std::cbrt(2.0) * std::pow(3.0, 5.0 / 6.0) *
         std::cbrt(mu * speed * s * s / granite.plane_strain_modulus);
}
double leak_off_asymptote(const TipFluid& fluid) {
  const double ratio =
      12.0 * fluid.viscosity * 2.0 * fluid.leak_off_coefficient / granite.plane_strain_modulus;
  return 2.5335 * std::pow(4.0 * speed * ratio * ratio, 0.125) * std::pow(s, 0.625);
}

TEST(TipLaw, HasItsThreeAsymptotes) {
  const TipLaw tough{7.5e8, 5e6}, brittle{7.5e8, 5e-9};
  EXPECT_NEAR(tough.opening(s, s, water, speed) / toughness_asymptote(tough), 1.0, 1e-6);
  EXPECT_NEAR(brittle.opening(s, s, water, speed) / viscosity_asymptote(water), 1.0, 1e-6);
  const TipFluid leaky{1e-3, 1.0};
  EXPECT_NEAR(brittle.opening(s, s, leaky, speed) / leak_off_asymptote(leaky), 1.0, 1.9e-4);
}

TEST(TipLaw, JoinsCubesWhereNothingLeaks) {
  const double expected = std::cbrt(std::pow(toughness_asymptote(granite), 3) +
                                    std::pow(viscosity_asymptote(water), 3));
  EXPECT_NEAR(granite.opening(s, s, water, speed), expected, 1e-12 * expected);
}

/// The leak-off that is let go of tends to none, and more of it widens the tip.
TEST(TipLaw, IsWidenedByLeakOff) {
  double before = granite.opening(s, s, water, speed);
  EXPECT_NEAR(granite.opening(s, s, {1e-3, 1e-12}, speed), before, 1e-6 * before);
  for (const double coefficient : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2}) {
    const double now = granite.opening(s, s, {1e-3, coefficient}, speed);
    EXPECT_GT(now, before);
    before = now;
  }
}

/// w satisfies dw/dS = (w + b) / w^2 C_1 in S = s^(1/2), by differences.
TEST(TipLaw, SolvesItsEquationInBetween) {
  const TipFluid leaky{1e-3, 1e-4};
  const double K = std::sqrt(32.0 / M_PI) * granite.toughness(), E = granite.plane_strain_modulus;
  const double scale = 12.0 * leaky.viscosity * E * E * speed / (K * K * K);
  const double b = (16.0 / 3.75) * std::tan(3.0 * M_PI / 8.0) / (6.0 * std::sqrt(3.0)) * 4.0 *
                   leaky.leak_off_coefficient * E / (K * std::sqrt(speed));
  const auto w = [&](double root) {
    const double at = root * root / (scale * scale);
    return granite.opening(at, at, leaky, speed) * E / (K * std::sqrt(at));
  };
  for (const double root : {0.01, 0.1, 1.0, 10.0}) {
    const double h = 1e-4 * root;
    const double rate = (w(root + h) - w(root - h)) / (2.0 * h);
    const double here = w(root);
    const double expected = 6.0 * std::sqrt(3.0) * (here + b) / std::pow(here, 3);
    EXPECT_NEAR(rate, expected, 9e-6 * expected) << root;
  }
}

}  // namespace
}  // namespace perifrac
