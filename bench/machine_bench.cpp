#include <array>
#include <vector>

#include <benchmark/benchmark.h>
#include <omp.h>

#include "core/base/packet.hpp"

namespace perifrac::bench {
namespace {

/// What the machine allows: a sum of two arrays too large for any cache, as bytes read and written.
void stream_memory(benchmark::State& state) {
  omp_set_num_threads(static_cast<int>(state.range(0)));
  const auto count = static_cast<std::ptrdiff_t>(state.range(1)) * (1 << 20) / 8;
  std::vector<double> a(count, 0.0), b(count, 1.0), c(count, 2.0);
  double* const sum = a.data();
  const double *const x = b.data(), *const y = c.data();
  for (auto _ : state) {
#pragma omp parallel for simd schedule(static)
    for (std::ptrdiff_t i = 0; i < count; ++i) sum[i] = x[i] + 3.0 * y[i];
    benchmark::DoNotOptimize(sum);
    benchmark::ClobberMemory();
  }
  state.SetBytesProcessed(state.iterations() * count * 3 * 8);
}

/// And products added to sums, in enough of them that none waits for another.
void multiply_and_add(benchmark::State& state) {
  constexpr int chains = 16;
  constexpr int length = 1 << 16;
  omp_set_num_threads(static_cast<int>(state.range(0)));
  double result = 0.0;
  for (auto _ : state) {
#pragma omp parallel reduction(+ : result)
    {
      std::array<Packet, chains> sum{};
      Packet factor{}, term{};
      factor += 0.5;
      term += 1.0;
      benchmark::DoNotOptimize(factor);
      benchmark::DoNotOptimize(term);
      for (int k = 0; k < length; ++k) {
        for (Packet& s : sum) s = s * factor + term;
      }
      for (const Packet& s : sum) result += s[0];
    }
  }
  benchmark::DoNotOptimize(result);
  state.counters["flop_per_s"] = benchmark::Counter(
      2.0 * chains * length * sizeof(Packet) / sizeof(double) * static_cast<double>(state.range(0)),
      benchmark::Counter::kIsIterationInvariantRate);
}

BENCHMARK(stream_memory)->ArgNames({"threads", "MiB"})->ArgsProduct({{1, 2}, {128}})->UseRealTime();
BENCHMARK(multiply_and_add)->ArgName("threads")->Arg(1)->Arg(2)->UseRealTime();

}  // namespace
}  // namespace perifrac::bench
