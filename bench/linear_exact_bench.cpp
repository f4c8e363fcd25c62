#include <vector>

#include <omp.h>

#include "bench/bench_bodies.hpp"
#include "core/operators/linear_exact.hpp"
#include "modules/pore_flow/material/darcy_law.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac::bench {
namespace {

/// A whole force: both passes over the bonds.
template <int D, class Law>
void apply_operator(benchmark::State& state, Law law) {
  const auto family = lattice_body<D>(D == 2 ? 316 : 46)->family(0);
  omp_set_num_threads(static_cast<int>(state.range(0)));
  LinearExactOperator<D, Law> op(family, MirrorCondition<D, Law::components>(*family), law);
  std::vector<double> u(op.size()), force(op.size());
  for (std::size_t k = 0; k < u.size(); ++k) u[k] = 1e-3 * static_cast<double>(k % 97);
  for (auto _ : state) {
    op.apply(u, force);
    benchmark::DoNotOptimize(force.data());
  }
  count_bonds<D>(state, *family);
}

template <int D>
void apply_flow(benchmark::State& state) {
  apply_operator<D>(state, DarcyLaw<D>{1.0});
}

template <int D>
void apply_solid(benchmark::State& state) {
  apply_operator<D>(state, IsotropicElasticity<D>{1.0, 1.0});
}

BENCHMARK(apply_flow<2>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(apply_flow<3>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(apply_solid<2>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK(apply_solid<3>)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace perifrac::bench
