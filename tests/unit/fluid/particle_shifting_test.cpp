#include <cmath>
#include <random>

#include "tests/unit/fluid/fluid_run.hpp"

namespace perifrac::test {
namespace {

const std::string flow = R"(
dimension: 2
time: {end: 10 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 1 MPa
  viscosity: 10 Pa s
)";
const std::string endless = R"(
  container: {from: [0 m, 0 m], to: [2 m, 2 m], faces: {left: periodic, right: periodic, bottom: periodic, top: periodic}}
  blocks: [{name: water, from: [0 m, 0 m], to: [2 m, 2 m], velocity: [3 m/s, 1 m/s]}]
)";
const std::string blob = R"(
  blocks: [{name: blob, from: [0 m, 0 m], to: [1 m, 1 m], velocity: [3 m/s, 0 m/s]}]
  domain: {from: [-50 m, -50 m], to: [50 m, 50 m]}
)";

void scatter(FluidRun& run, double jitter) {
  std::mt19937 bits(5);
  std::uniform_real_distribution<double> shift(-jitter, jitter);
  for (const char* name : {"position_x", "position_y"}) {
    auto x = run.field(name);
    for (double& component : x) component += shift(bits);
    run.set(name, x);
  }
}

/// Distances to the nearest point, across the periods of 2 m: least and standard deviation [m].
struct Regularity {
  double least, deviation;
};

Regularity regularity(FluidRun& run) {
  const auto x = run.field("position_x"), y = run.field("position_y");
  double least = 1.0, sum = 0.0, squares = 0.0;
  const auto apart = [](double a, double b) { return std::remainder(a - b, 2.0); };
  for (std::size_t i = 0; i < x.size(); ++i) {
    double nearest = 1.0;
    for (std::size_t j = 0; j < x.size(); ++j) {
      if (j == i) continue;
      nearest = std::min(nearest, std::hypot(apart(x[i], x[j]), apart(y[i], y[j])));
    }
    least = std::min(least, nearest);
    sum += nearest;
    squares += nearest * nearest;
  }
  const double n = static_cast<double>(x.size());
  return {least, std::sqrt(std::max(0.0, squares / n - sum * sum / n / n))};
}

TEST(ParticleShifting, MakesDisorderedPointsMoreRegular) {
  std::vector<Regularity> after;
  for (const char* shifting : {"fluid.particle_shifting=0", "fluid.particle_shifting=4"}) {
    FluidRun run(flow + endless, {shifting});
    scatter(run, 0.03);
    const Regularity before = regularity(run);
    EXPECT_LT(before.least, 0.06);
    EXPECT_GT(before.deviation, 0.01);
    run.run_for(0.5);
    after.push_back(regularity(run));
  }
  EXPECT_GT(after[1].least, 0.08);
  EXPECT_GT(after[1].least, after[0].least);
  EXPECT_LT(after[1].deviation, 0.005);
  EXPECT_LT(after[1].deviation, 0.7 * after[0].deviation);
}

/// Velocities do not notice, so momentum and mass stay; where a point is does change.
TEST(ParticleShifting, KeepsMassAndMomentum) {
  FluidRun run(flow + endless);
  scatter(run, 0.03);
  const double mass = run.value("free_fluid_mass"), size = std::abs(run.momentum(0));
  const double before[] = {run.momentum(0), run.momentum(1)};
  run.steps(300);
  EXPECT_NEAR(run.value("free_fluid_mass"), mass, 1e-14 * mass);
  for (int a = 0; a < 2; ++a) EXPECT_NEAR(run.momentum(a), before[a], 1e-13 * size);
}

/// A lattice that flies on its own stays as it is: points at its surface, and those below, are not
/// shifted out of it.
TEST(ParticleShifting, LeavesAFreeSurfaceWhereItIs) {
  FluidRun run(flow + blob, {"fluid.particle_shifting=10"});
  run.steps(500);
  const auto x = run.field("position_x"), y = run.field("position_y");
  const auto [left, right] = std::ranges::minmax(x);
  const auto [bottom, top] = std::ranges::minmax(y);
  EXPECT_NEAR(right - left, 0.9, 0.01);
  EXPECT_NEAR(top - bottom, 0.9, 0.01);
}

}  // namespace
}  // namespace perifrac::test
