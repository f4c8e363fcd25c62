#include "bench/bench_bodies.hpp"
#include "core/operators/linear_exact.hpp"
#include "core/solvers/sparse_cholesky.hpp"
#include "modules/solid/material/isotropic_elasticity.hpp"

namespace perifrac::bench {
namespace {

template <int D>
Eigen::SparseMatrix<double> stiffness(int count) {
  const auto family = box_body<D>(count)->family(0);
  return LinearExactOperator<D, IsotropicElasticity<D>>(family, MirrorCondition<D, D>(*family),
                                                        {1.0, 1.0})
      .assemble();
}

void describe(benchmark::State& state, const Eigen::SparseMatrix<double>& matrix) {
  state.counters["unknowns"] = static_cast<double>(matrix.rows());
  state.counters["entries_per_row"] =
      static_cast<double>(matrix.nonZeros()) / static_cast<double>(matrix.rows());
}

template <int D>
void assemble_solid(benchmark::State& state) {
  Eigen::SparseMatrix<double> matrix;
  for (auto _ : state) matrix = stiffness<D>(static_cast<int>(state.range(0)));
  describe(state, matrix);
}

/// Ordering and factor; the free body is held by a weak spring at every point.
template <int D>
void factor_solid(benchmark::State& state) {
  Eigen::SparseMatrix<double> matrix = stiffness<D>(static_cast<int>(state.range(0)));
  for (Eigen::Index k = 0; k < matrix.rows(); ++k) matrix.coeffRef(k, k) += 1e-3;
  for (auto _ : state) SparseCholesky().factor(matrix);
  describe(state, matrix);
}

BENCHMARK(assemble_solid<2>)->Arg(20)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);
BENCHMARK(assemble_solid<3>)->Arg(8)->Arg(12)->Unit(benchmark::kMillisecond);
BENCHMARK(factor_solid<2>)->Arg(20)->Arg(40)->Arg(80)->Unit(benchmark::kMillisecond);
BENCHMARK(factor_solid<3>)->Arg(8)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace perifrac::bench
