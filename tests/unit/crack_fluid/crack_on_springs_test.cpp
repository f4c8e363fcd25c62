#include <gtest/gtest.h>

#include "tests/unit/crack_fluid/crack_run.hpp"

namespace perifrac {
namespace {

using namespace test;

/// A crack whose every point opens by c p of its own pressure (Winkler), fed at its end at a
/// constant inflow Q: w_t = A (w^3 w_x)_x, A = 1 / (12 mu c), -A w^3 w_x = Q at x = 0 (Barenblatt
/// 1952). With w = t^(1/5) f(x / t^(4/5)), Q = 1 and A = 1:
///   f/5 - 4/5 xi f' = (f^3 f')', which with M = int_xi^front f is f^2 f' = -(4/5 xi + M / f) f^0,
/// integrated back from the front, xi = 1, and scaled to the inflow.
struct SimilarCrack {
  double front;  ///< xi where it ends
  double inlet;  ///< f at the inlet

  SimilarCrack() {
    // g = f^3: g' = -3 (4/5 xi + M / f), M' = -f; near the front f^3 = 12/5 (1 - xi), M/f small.
    const int steps = 20000;
    const double h = 1.0 / steps;
    const auto slope = [](double xi, double g, double m) {
      const double f = std::cbrt(g);
      return std::array{3.0 * (0.8 * xi + (f > 0.0 ? m / f : 0.0)), f};  // going backwards
    };
    double g = 0.0;
    double m = 0.0;
    for (int k = 0; k < steps; ++k) {
      const double xi = 1.0 - k * h;
      const auto a = slope(xi, g, m);
      const auto b = slope(xi - 0.5 * h, g + 0.5 * h * a[0], m + 0.5 * h * a[1]);
      const auto c = slope(xi - 0.5 * h, g + 0.5 * h * b[0], m + 0.5 * h * b[1]);
      const auto d = slope(xi - h, g + h * c[0], m + h * c[1]);
      g += h / 6.0 * (a[0] + 2.0 * b[0] + 2.0 * c[0] + d[0]);
      m += h / 6.0 * (a[1] + 2.0 * b[1] + 2.0 * c[1] + d[1]);
    }
    // Lengths times s and f times s^(2/3) solve it too, with the inflow, here M, times s^(5/3).
    front = std::pow(m, -0.6);
    inlet = std::cbrt(g) * std::pow(front, 2.0 / 3.0);
  }
};

constexpr double compliance = 1e-10;  ///< [m/Pa]
constexpr double inflow = 1e-5;
constexpr double end = 0.1;

struct Errors {
  double front, inlet, energy;
};

Errors errors(int facets, int windows) {
  const double a = 1.0 / (12.0 * water.viscosity * compliance);
  const SimilarCrack similar;
  // Dimensions: w^3 A t = x^2 and w x = Q t.
  const double x_scale = std::pow(a * std::pow(inflow, 3) * std::pow(end, 4), 0.2);
  const double w_scale = inflow * end / x_scale;
  const double dx = 1.3 * similar.front * x_scale / facets;

  CrackRun run(water, {rate_inlet({0.0, 0.0}, inflow)});
  run.add_line(straight_line({0.0, 0.0}, 0.0, dx, facets));
  run.open(0.0, compliance);
  run.advance(end, windows);
  EXPECT_LT(run.mass_error(), 1e-14);

  const auto p = run.values("crack_pressure");
  double springs = 0.0;
  for (const double pressure : p) springs += 0.5 * compliance * pressure * pressure * dx;
  const double energy = run.scalar("crack_fluid_energy") + springs +
                        run.scalar("crack_flow_dissipation") - run.scalar("crack_fluid_work");
  return {run.scalar("wetted_length") / (similar.front * x_scale) - 1.0,
          p[0] * compliance / (similar.inlet * w_scale) - 1.0,
          energy / run.scalar("crack_fluid_work")};
}

TEST(CrackOnSprings, SimilaritySolutionBalancesItsVolume) {
  // d/dt of the volume is the inflow, so that M = Q at the inlet: what the scaling rests on.
  const SimilarCrack similar;
  EXPECT_GT(similar.front, 1.0);
  EXPECT_LT(similar.front, 1.5);
}

TEST(CrackOnSprings, GrowsAsTheSimilaritySolution) {
  const Errors coarse = errors(50, 100);
  const Errors fine = errors(100, 200);
  EXPECT_LT(std::abs(fine.front), 0.5 * std::abs(coarse.front));
  EXPECT_LT(std::abs(fine.front), 0.02);
  EXPECT_LT(std::abs(fine.inlet), 0.0035);
  EXPECT_LT(std::abs(fine.energy), 1e-5);
}

}  // namespace
}  // namespace perifrac
