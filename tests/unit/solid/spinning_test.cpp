#include <numbers>

#include <gtest/gtest.h>

#include "tests/unit/solid/turning.hpp"

namespace perifrac {
namespace {

using test::density;
using test::lambda;
using test::mu;
using test::Spinning;

// Of a thin strip in plane strain.
const double stiffness = 4.0 * mu * (lambda + mu) / (lambda + 2.0 * mu);
const double wave = std::sqrt(stiffness / density);

/// Velocities of a body that spins about its middle.
template <int D>
std::vector<double> spin(Spinning<D>& solid, const std::vector<double>& u, double rate) {
  const Index n = solid.body->points().size();
  Vector<2> middle{};
  for (Index i = 0; i < n; ++i) {
    for (int a = 0; a < 2; ++a) {
      middle[a] += (solid.body->points().position[a][i] + u[a * n + i]) / n;
    }
  }
  std::vector<double> v(u.size(), 0.0);
  for (Index i = 0; i < n; ++i) {
    v[i] = -rate * (solid.body->points().position[1][i] + u[n + i] - middle[1]);
    v[n + i] = rate * (solid.body->points().position[0][i] + u[i] - middle[0]);
  }
  return v;
}

template <int D>
double angular_momentum(Spinning<D>& solid) {
  const auto u = solid.port("displacement").value;
  const auto v = solid.field("velocity");
  const Index n = solid.body->points().size();
  double sum = 0.0;
  for (Index i = 0; i < n; ++i) {
    const double x = solid.body->points().position[0][i] + u[i];
    const double y = solid.body->points().position[1][i] + u[n + i];
    sum += density * solid.body->points().volume[i] * (x * v[n + i] - y * v[i]);
  }
  return sum;
}

/// From end to end.
double length_now(Spinning<2>& strip, int cells, int rows) {
  const auto u = strip.port("displacement").value;
  const Index n = strip.body->points().size();
  Vector<2> ends[2] = {};
  const double far = *std::ranges::max_element(strip.body->points().position[0]);
  const double near = *std::ranges::min_element(strip.body->points().position[0]);
  for (Index i = 0; i < n; ++i) {
    const double x = strip.body->points().position[0][i];
    for (const int end : {0, 1}) {
      if (x != (end == 1 ? far : near)) continue;
      ends[end][0] += (x + u[i]) / rows;
      ends[end][1] += (strip.body->points().position[1][i] + u[n + i]) / rows;
    }
  }
  const double between = std::hypot(ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]);
  return between * cells / (cells - 1);
}

/// Let go at its first length, a strip that spins vibrates about the length at which it would spin
/// steadily. E u'' + rho W^2 (x + u) = 0, u' = 0 at the ends, has with k = W / c the solution
/// sin(k x) / (k cos(k L / 2)) - x.
double stretch_error(int cells) {
  const double length = 20.0, spacing = length / cells;
  const int rows = cells / 10;
  Spinning<2> strip({cells, rows}, spacing);
  strip.start();
  const std::vector<double> rest(strip.body->points().size() * 2, 0.0);
  const double rate = 0.02 * wave / length;
  strip.set(rest, spin(strip, rest, rate));
  const double period = 2.0 * length / wave;  // about that of the first vibration
  double mean = 0.0;
  const int samples = 400;
  for (int n = 0; n < samples; ++n) {
    strip.advance(20.0 * period / samples);
    mean += length_now(strip, cells, rows) / samples;
  }
  const double k = rate / wave;
  const double exact = 2.0 * std::tan(0.5 * k * length) / k - length;
  return (mean - length) / exact - 1.0;
}

TEST(SpinningBody, AStripStretchesAsItsSpinPulls) {
  const double coarse = std::abs(stretch_error(30)), fine = std::abs(stretch_error(60));
  EXPECT_LT(fine, 1.5e-2);
  EXPECT_LT(fine, 0.6 * coarse);
}

struct Balance {
  double spread;    ///< of the energy, over the elastic one at first
  double drift;     ///< of its mean from the first half of the time to the second
  double momentum;  ///< largest error of the angular momentum
};

/// A strained body turns a hundred times without a load.
Balance balance(double safety) {
  Spinning<2> body({10, 6});
  body.safety = safety;
  body.start();
  const auto u = test::moved(*body.body, [](const auto& x) -> Eigen::Vector2d {
    return {x[0] + 1e-2 * std::sin(x[1]), x[1] - 1e-2 * x[0] * x[1]};
  });
  const double rate = 0.05;
  body.set(u, spin(body, u, rate));
  const double momentum = angular_momentum(body), elastic = body.value("elastic_energy");
  double least = body.energy(), most = least;
  Balance found{};
  const int windows = 400;
  for (int n = 0; n < windows; ++n) {
    body.advance(100.0 * 2.0 * std::numbers::pi / rate / windows);
    const double energy = body.energy();
    least = std::min(least, energy);
    most = std::max(most, energy);
    found.drift += (n < windows / 2 ? -2.0 : 2.0) / windows * energy / elastic;
    const double error = angular_momentum(body) / momentum - 1.0;
    found.momentum = std::max(found.momentum, std::abs(error));
  }
  found.spread = (most - least) / elastic;
  return found;
}

/// What the scheme makes of its vibrations falls with the square of the step and does not grow.
TEST(SpinningBody, KeepsItsEnergyAndItsAngularMomentumOverManyTurns) {
  const Balance coarse = balance(0.6), fine = balance(0.2);
  EXPECT_LT(fine.spread, 0.02);
  EXPECT_GT(coarse.spread / fine.spread, 6.0);
  EXPECT_LT(std::abs(coarse.drift), 0.05 * coarse.spread);
  EXPECT_LT(std::abs(fine.drift), 0.05 * fine.spread);
  EXPECT_LT(coarse.momentum, 1e-11);
  EXPECT_LT(fine.momentum, 1e-11);
}

}  // namespace
}  // namespace perifrac
