#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "modules/fluid/fluid_dynamics.hpp"
#include "modules/fluid/semi_lagrangian/semi_lagrangian_method.hpp"
#include "modules/fluid/walls/two_sided_wall_force.hpp"

namespace perifrac::bench {
namespace {

/// Water in a periodic box of `count` points an axis, jittered, in vortices of a tenth of the
/// sound's speed.
template <int D>
FluidDynamics<D> stirred_water(int count) {
  const FluidProperties water{.density = 1000.0, .bulk_modulus = 1e5, .viscosity = 1e-3};
  const FluidScheme scheme{.spacing = 1.0,
                           .horizon = 2.5,
                           .artificial_viscosity = 0.1,
                           .density_diffusion = 0.5,
                           .shifting = 0.0,
                           .courant = 0.35};
  std::mt19937 bits(1);
  std::uniform_real_distribution<double> shift(-0.2, 0.2);
  const double wave = 2.0 * std::numbers::pi / count;
  FluidPoints<D> points;
  for (int n = 0; n < std::pow(count, D); ++n) {
    Vector<D> x, v{};
    for (int a = 0, rest = n; a < D; ++a, rest /= count) x[a] = rest % count + 0.5 + shift(bits);
    v[0] = 0.1 * water.sound_speed() * std::sin(wave * x[0]) * std::cos(wave * x[1]);
    v[1] = -0.1 * water.sound_speed() * std::cos(wave * x[0]) * std::sin(wave * x[1]);
    points.add(x, v, water.density, water.density);
  }
  Period<D> period;
  for (auto& ends : period.ends) ends = {0.0, static_cast<double>(count)};
  Region<D> everywhere;
  everywhere.from.fill(-std::numeric_limits<double>::infinity());
  everywhere.to.fill(std::numeric_limits<double>::infinity());
  return FluidDynamics<D>(
      water, scheme, std::get<FluidMethodType::Maker<D>>(semi_lagrangian_method().make)(scheme),
      Vector<D>{}, period, std::move(points), WallCloud<D>{}, {}, 0,
      {nullptr, nullptr, FluidDomain<D>(everywhere, 0)}, std::make_unique<TwoSidedWallForce<D>>(),
      nullptr);
}

/// Whole steps, the search for neighbours included: points times steps per second.
template <int D>
void step_fluid(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  FluidDynamics<D> fluid = stirred_water<D>(D == 2 ? 224 : 37);
  std::int64_t steps = 0;
  double t = 0.0;
  for (auto _ : state) {
    const double length = fluid.longest_step(t);
    fluid.step(t, length);
    t += length;
    ++steps;
  }
  state.counters["million_particle_steps_per_s"] = benchmark::Counter(
      1e-6 * fluid.points().count, benchmark::Counter::kIsIterationInvariantRate);
  state.counters["steps_a_search"] = static_cast<double>(steps) / fluid.searches();
}

BENCHMARK(step_fluid<2>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(step_fluid<3>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace perifrac::bench
