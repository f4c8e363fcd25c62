#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

constexpr int facets = 20;
constexpr double high = 2e5, low = 0.5e5;

/// So stiff that the density is the same everywhere.
constexpr CrackLiquid incompressible{
    .density = 1000.0, .viscosity = 1e-3, .bulk_modulus = 1e18, .residual_aperture = 1e-9};

const std::vector<CrackFilling<2>> all_full = {{{"", {-1.0, -1.0}, {1.0, 1.0}}, low}};

/// w^3 / (12 mu) times the fall of pressure, over the distance.
double cubic_law(double distance) {
  return w * w * w / (12.0 * incompressible.viscosity) * (high - low) / distance;
}

/// The flow rates of the facets of a line between pressures at its first and last facet, steady.
std::vector<double> steady_rates(const std::vector<Vector<2>>& corners, double& mass_error) {
  const auto middle = [&](std::size_t k) {
    return Vector<2>{0.5 * (corners[k][0] + corners[k + 1][0]),
                     0.5 * (corners[k][1] + corners[k + 1][1])};
  };
  CrackRun run(incompressible,
               {pressure_inlet("in", middle(0), high),
                pressure_inlet("out", middle(corners.size() - 2), low)},
               all_full);
  run.add_line(corners);
  run.open(w);
  run.advance(1.0, 3);
  mass_error = run.mass_error();
  return run.values("crack_flow_rate");
}

void expect_cubic_law(const std::vector<Vector<2>>& corners) {
  double mass_error = 1.0;
  const std::vector<double> rates = steady_rates(corners, mass_error);
  const double expected = cubic_law((facets - 1) * dx);
  for (std::size_t f = 1; f + 1 < rates.size(); ++f) {
    EXPECT_NEAR(rates[f], expected, 1e-10 * expected) << f;
  }
  EXPECT_LT(mass_error, 1e-14);
}

TEST(SlitFlow, FollowsTheCubicLawAtAnyAngle) {
  for (const double angle : {0.0, 0.25 * std::numbers::pi, 0.4636}) {
    SCOPED_TRACE(angle);
    expect_cubic_law(straight_line({0.3, 0.2}, angle, dx, facets));
  }
}

TEST(SlitFlow, GoesRoundCorners) {
  auto corners = straight_line({0.3, 0.2}, 0.0, dx, facets / 2);
  const auto bent = straight_line(corners.back(), 1.1, dx, facets / 2);
  corners.insert(corners.end(), bent.begin() + 1, bent.end());
  expect_cubic_law(corners);
}

/// A line whose first and last facet hold pressures, and from its middle a branch.
struct Fork {
  CrackRun run;

  explicit Fork(double branch_pressure)
      : run(incompressible,
            {pressure_inlet("in", {0.5 * dx, 0.0}, high),
             pressure_inlet("out", {9.5 * dx, 0.0}, low),
             pressure_inlet("up", {5.0 * dx, 4.5 * dx}, branch_pressure)},
            {{{"", {-1.0, -1.0}, {1.0, 1.0}}, low}}) {
    const auto line = straight_line({0.0, 0.0}, 0.0, dx, 10);
    run.add_line(line);
    run.add_line(straight_line(line[5], 0.5 * std::numbers::pi, dx, 5));
  }
  double rate(int facet) { return run.values("crack_flow_rate")[facet]; }
};

TEST(SlitFlow, DividesAtAJunctionAsResistancesDo) {
  Fork fork(low);
  fork.run.open(w);
  fork.run.advance(1.0, 3);
  // One arm of 4.5 dx in series with two of 4.5 dx side by side.
  const double expected = cubic_law(4.5 * dx * 1.5);
  EXPECT_NEAR(fork.rate(2), expected, 1e-10 * expected);
  EXPECT_NEAR(fork.rate(7), 0.5 * expected, 1e-10 * expected);
  EXPECT_NEAR(fork.rate(12), 0.5 * expected, 1e-10 * expected);
  EXPECT_LT(fork.run.mass_error(), 1e-14);
}

TEST(SlitFlow, PassesAClosedBranchAsIfItWereNotThere) {
  Fork fork(low);
  fork.run.open(w);
  const PortView opening = fork.run.port("free_crack_opening");
  for (int f = 10; f < 15; ++f) opening.value[f] = 0.0;
  fork.run.advance(1.0, 3);
  const double expected = cubic_law(9.0 * dx);
  EXPECT_NEAR(fork.rate(2), expected, 1e-10 * expected);
  EXPECT_NEAR(fork.rate(7), expected, 1e-10 * expected);
}

TEST(SlitFlow, ClosedSlitHasItsResidualAperture) {
  CrackLiquid liquid = incompressible;
  liquid.residual_aperture = w;
  CrackRun run(
      liquid,
      {pressure_inlet("in", {0.5 * dx, 0.0}, high), pressure_inlet("out", {9.5 * dx, 0.0}, low)},
      all_full);
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, 10));
  run.open(-1e-5);
  run.advance(1.0, 3);
  EXPECT_NEAR(run.values("crack_flow_rate")[4], cubic_law(9.0 * dx), 1e-10 * cubic_law(9.0 * dx));
}

}  // namespace
}  // namespace perifrac
