#include <vector>

#include <omp.h>

#include "bench/bench_bodies.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/lps_elasticity.hpp"

namespace perifrac::bench {
namespace {

enum class Stress { none, initial };

template <int D>
std::optional<Vector<D>> initial_stress(benchmark::State& state) {
  if (static_cast<Stress>(state.range(1)) == Stress::none) return {};
  Vector<D> stress;
  stress.fill(-1.0);
  return stress;
}

/// A whole force of an elastic material under pore stress: both passes over the bonds.
template <int D>
void apply_material(benchmark::State& state, const Family<D>& family, ElasticOperator<D>& solid) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  std::vector<double> u(solid.size()), force(u.size()), dilatation(family.point_count);
  const std::vector<double> pore_stress(family.point_count, 1.0);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-3 * static_cast<double>(k % 97);
  for (auto _ : state) {
    solid.apply(u, {pore_stress}, force, dilatation);
    benchmark::DoNotOptimize(force.data());
  }
  count_bonds<D>(state, family);
}

template <int D>
void apply_linear_exact(benchmark::State& state) {
  using Law = IsotropicElasticity<D>;
  const auto family = lattice_body<D>(D == 2 ? 316 : 46)->family(0);
  LinearExactElasticity<D, Law> solid(
      LinearExactOperator<D, Law>(family, MirrorCondition<D, D>(*family), {1.0, 1.0}),
      initial_stress<D>(state));
  apply_material<D>(state, *family, solid);
}

template <int D>
void apply_lps(benchmark::State& state) {
  const auto family = lattice_body<D>(D == 2 ? 316 : 46)->family(0);
  LpsElasticity<D> solid(family, MirrorCondition<D, D>(*family),
                         {{{1.0, 1.0}}, std::vector<std::uint8_t>(family->point_count)},
                         initial_stress<D>(state));
  apply_material<D>(state, *family, solid);
}

void settings(benchmark::internal::Benchmark* bench) {
  constexpr auto none = static_cast<long>(Stress::none);
  constexpr auto initial = static_cast<long>(Stress::initial);
  bench->ArgNames({"threads", "initial_stress"})
      ->ArgsProduct({{1, 2}, {none, initial}})
      ->UseRealTime();
}

BENCHMARK(apply_linear_exact<2>)->Apply(settings);
BENCHMARK(apply_linear_exact<3>)->Apply(settings);
BENCHMARK(apply_lps<2>)->Apply(settings);
BENCHMARK(apply_lps<3>)->Apply(settings);

}  // namespace
}  // namespace perifrac::bench
