#include <vector>

#include <omp.h>

#include "bench/bench_bodies.hpp"
#include "core/bonds/bond_traversal.hpp"

namespace perifrac::bench {
namespace {

/// The traversal alone: one value of the other end per bond, D sums a point.
template <int D>
void traverse_bonds(benchmark::State& state) {
  const auto body = large_body<D>(static_cast<Cloud>(state.range(0)));
  const auto family = body->family(0);
  omp_set_num_threads(static_cast<int>(state.range(1)));
  const std::vector<double> field(family->node_count(), 1.0);
  std::vector<double> sums(family->point_count);
  for (auto _ : state) {
    for_each_point(family->point_count, [&](Index i) {
      const auto sum = sum_over_bonds<D>(*family, i, [&](Index j, const Vector<D>& xi, double w) {
        std::array<double, D> t;
        for (int a = 0; a < D; ++a) t[a] = w * field[j] * xi[a];
        return t;
      });
      sums[i] = sum[0];
    });
    benchmark::DoNotOptimize(sums.data());
  }
  count_bonds<D>(state, *family);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations()) * family->steps.total() *
                          (sizeof(Index) + sizeof(double)));
}

constexpr auto sorted = static_cast<long>(Cloud::lattice);
constexpr auto shuffled = static_cast<long>(Cloud::shuffled);

BENCHMARK(traverse_bonds<2>)
    ->ArgNames({"shuffled", "threads"})
    ->ArgsProduct({{sorted, shuffled}, {1, 2}})
    ->UseRealTime();
BENCHMARK(traverse_bonds<3>)
    ->ArgNames({"shuffled", "threads"})
    ->ArgsProduct({{sorted, shuffled}, {1, 2}})
    ->UseRealTime();

}  // namespace
}  // namespace perifrac::bench
