#include <vector>

#include <omp.h>

#include "bench/bench_bodies.hpp"
#include "core/operators/linear_exact.hpp"
#include "modules/pore_flow/material/anisotropic_darcy_law.hpp"
#include "modules/pore_flow/material/darcy_law.hpp"

namespace perifrac::bench {
namespace {

/// The flow of pressures: both passes over the bonds.
template <int D, class Law>
void apply_law(benchmark::State& state, Law law) {
  const auto family = large_body<D>(static_cast<Cloud>(state.range(1)))->family(0);
  omp_set_num_threads(static_cast<int>(state.range(0)));
  LinearExactOperator<D, Law> op(family, MirrorCondition<D, 1>(*family), law);
  std::vector<double> p(op.size()), outflow(op.size());
  for (std::size_t k = 0; k < p.size(); ++k) p[k] = 1e-3 * static_cast<double>(k % 97);
  for (auto _ : state) {
    op.apply(p, outflow);
    benchmark::DoNotOptimize(outflow.data());
  }
  count_bonds<D>(state, *family);
  state.SetLabel(op.path());
}

template <int D>
void apply_flow(benchmark::State& state) {
  apply_law<D>(state, DarcyLaw<D>{1.0});
}

template <int D>
void apply_tensor_flow(benchmark::State& state) {
  AnisotropicDarcyLaw<D> law{};
  for (int a = 0; a < D; ++a) law.mobility[a * D + a] = 1.0 + a;
  apply_law<D>(state, law);
}

void flow_settings(benchmark::internal::Benchmark* bench) {
  constexpr auto lattice = static_cast<long>(Cloud::lattice);
  constexpr auto jittered = static_cast<long>(Cloud::jittered);
  bench->ArgNames({"threads", "cloud"})->ArgsProduct({{1, 2}, {lattice, jittered}})->UseRealTime();
}

BENCHMARK(apply_flow<2>)->Apply(flow_settings);
BENCHMARK(apply_flow<3>)->Apply(flow_settings);
BENCHMARK(apply_tensor_flow<2>)->Apply(flow_settings);
BENCHMARK(apply_tensor_flow<3>)->Apply(flow_settings);

}  // namespace
}  // namespace perifrac::bench
