#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

constexpr double length = 0.05;  ///< half of a slit that is held at both ends [m]
constexpr double step = 1e3;     ///< of pressure [Pa], so small that the fluid is linear
constexpr CrackLiquid liquid{
    .density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 2.2e9, .residual_aperture = 1e-9};

/// The pressures in a full slit, over the jump, once its first facet has jumped from 0 to a
/// pressure while its last one holds 0.
std::vector<double> pressures(int facets, int windows) {
  const double dx = length / (facets - 1);
  const double diffusivity = w * w * liquid.bulk_modulus / (12.0 * liquid.viscosity);
  const double end = 0.1 * length * length / diffusivity;
  CrackRun run(liquid,
               {pressure_inlet("in", {0.0, 0.0}, step), pressure_inlet("out", {length, 0.0}, 0.0)},
               {{{"", {-1.0, -1.0}, {1.0, 1.0}}, 0.0}});
  run.add_line(straight_line({-0.5 * dx, 0.0}, 0.0, dx, facets));
  run.open(w);
  run.advance(end, windows);
  EXPECT_LT(run.mass_error(), 1e-14);
  auto p = run.values("crack_pressure");
  for (double& value : p) value /= step;
  return p;
}

/// The series of the diffusion that w^2 K_f / (12 mu) makes of it.
double exact(double x) {
  double p = 1.0 - x;
  for (int n = 1; n < 100; ++n) {
    const double k = n * std::numbers::pi;
    p -= 2.0 / k * std::sin(k * x) * std::exp(-k * k * 0.1);
  }
  return p;
}

double error(int windows) {
  const auto p = pressures(101, windows);
  double largest = 0.0;
  for (int f = 0; f <= 100; ++f) largest = std::max(largest, std::abs(p[f] - exact(0.01 * f)));
  return largest;
}

TEST(CrackDiffusion, IsFirstOrderInTime) {
  const double coarse = error(20);
  const double fine = error(40);
  EXPECT_LT(fine, 5e-3);
  EXPECT_NEAR(std::log2(coarse / fine), 1.0, 2e-5);
}

TEST(CrackDiffusion, IsSecondOrderInSpace) {
  const auto at_quarter = [](int facets) { return pressures(facets, 400)[(facets - 1) / 4]; };
  const double coarse = at_quarter(5);
  const double middle = at_quarter(9);
  const double fine = at_quarter(17);
  EXPECT_NEAR(fine, exact(0.25), 8e-4);
  EXPECT_NEAR(std::log2((coarse - middle) / (middle - fine)), 2.0, 7.5e-3);
}

}  // namespace
}  // namespace perifrac
