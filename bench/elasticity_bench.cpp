#include <vector>

#include <omp.h>

#include "bench/bench_bodies.hpp"
#include "core/bonds/bond_state.hpp"
#include "modules/solid/material/linear_exact_elasticity.hpp"
#include "modules/solid/material/lps_elasticity.hpp"

namespace perifrac::bench {
namespace {

enum class Load { none, pore_stress, pore_and_initial_stress };
enum class Bonds { whole, some_broken, jittered };

Load load(benchmark::State& state) { return static_cast<Load>(state.range(1)); }

/// Every hundredth bond is broken, in `some_broken`.
template <int D>
std::shared_ptr<const Family<D>> family(benchmark::State& state) {
  const auto bonds = static_cast<Bonds>(state.range(2));
  const auto body = large_body<D>(bonds == Bonds::jittered ? Cloud::jittered : Cloud::lattice);
  if (bonds != Bonds::some_broken) return body->family(0);
  const auto cut = std::make_shared<Family<D>>(*body->family(0));
  for (Index i = 0; i < cut->point_count; ++i) {
    for (const auto& bond : cut->bonds(i)) {
      const Index j = bond.other;
      if (i < j && (i + j) % 100 == 0) silence(*cut, i, j);
    }
  }
  return cut;
}

template <int D>
std::optional<Vector<D>> initial_stress(benchmark::State& state) {
  if (load(state) != Load::pore_and_initial_stress) return {};
  Vector<D> stress;
  stress.fill(-1.0);
  return stress;
}

/// A whole force of an elastic material: all passes over the bonds.
template <int D>
void apply_material(benchmark::State& state, const Family<D>& family, ElasticOperator<D>& solid) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  std::vector<double> u(solid.size()), force(u.size()), dilatation(family.point_count);
  const std::vector<double> pore_stress(family.point_count, 1.0);
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-3 * static_cast<double>(k % 97);
  for (auto _ : state) {
    if (load(state) == Load::none) {
      solid.apply(u, {}, force, {});
    } else {
      solid.apply(u, {pore_stress}, force, dilatation);
    }
    benchmark::DoNotOptimize(force.data());
  }
  count_bonds<D>(state, family);
  state.SetLabel(solid.path());
}

template <int D>
void apply_linear_exact(benchmark::State& state) {
  using Law = IsotropicElasticity<D>;
  const auto bonds = family<D>(state);
  LinearExactElasticity<D, Law> solid(
      LinearExactOperator<D, Law>(bonds, MirrorCondition<D, D>(*bonds), {1.0, 1.0}),
      initial_stress<D>(state));
  apply_material<D>(state, *bonds, solid);
}

template <int D>
void apply_lps(benchmark::State& state) {
  const auto bonds = family<D>(state);
  LpsElasticity<D> solid(bonds, MirrorCondition<D, D>(*bonds),
                         {{{1.0, 1.0}}, std::vector<std::uint8_t>(bonds->point_count)},
                         initial_stress<D>(state));
  apply_material<D>(state, *bonds, solid);
}

void settings(benchmark::internal::Benchmark* bench) {
  constexpr auto as_number = [](auto value) { return static_cast<long>(value); };
  bench->ArgNames({"threads", "load", "bonds"})->UseRealTime();
  for (const long threads : {1, 2}) {
    for (const Load load : {Load::none, Load::pore_stress, Load::pore_and_initial_stress}) {
      bench->Args({threads, as_number(load), as_number(Bonds::whole)});
    }
    for (const Bonds bonds : {Bonds::some_broken, Bonds::jittered}) {
      bench->Args({threads, as_number(Load::none), as_number(bonds)});
    }
  }
}

BENCHMARK(apply_linear_exact<2>)->Apply(settings);
BENCHMARK(apply_linear_exact<3>)->Apply(settings);
BENCHMARK(apply_lps<2>)->Apply(settings);
BENCHMARK(apply_lps<3>)->Apply(settings);

}  // namespace
}  // namespace perifrac::bench
