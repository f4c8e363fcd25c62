#pragma once

#include <array>
#include <span>

#include "core/base/for_each_point.hpp"
#include "core/bonds/family.hpp"

namespace perifrac {

template <int K, int D, class Weight, class Term>
inline std::array<double, K> sum_weighted(const Family<D>& family, Index i, const Weight& weight,
                                          Term&& term) {
  double sum[K] = {};
  const Vector<D> x = [&] {
    Vector<D> at;
    for (int a = 0; a < D; ++a) at[a] = family.position[a][i];
    return at;
  }();
  std::array<const double*, D> position;
  for (int a = 0; a < D; ++a) position[a] = family.position[a].data();
  const std::span<const Index> steps = family.steps[i];
  const Index* const step = steps.data();
  const Index count = static_cast<Index>(steps.size());
#pragma omp simd reduction(+ : sum[:K])
  for (Index n = 0; n < count; ++n) {
    const Index j = i + step[n];
    Vector<D> xi;
    for (int a = 0; a < D; ++a) xi[a] = position[a][j] - x[a];
    const std::array<double, K> t = term(j, xi, weight[n]);
    for (int k = 0; k < K; ++k) sum[k] += t[k];
  }
  std::array<double, K> result;
  for (int k = 0; k < K; ++k) result[k] = sum[k];
  return result;
}

/// The one loop over the bonds of a point: the sum over its bonds of term(j, xi, weight), where j
/// is the bond's other end (a real point or a ghost), xi the bond vector [m] and weight
/// omega(|xi|) V_j. How bonds are stored is known here and in Family alone.
template <int K, int D, class Term>
inline std::array<double, K> sum_over_bonds(const Family<D>& family, Index i, Term&& term) {
  return family.weight.with(
      i, [&](const auto& weight) { return sum_weighted<K>(family, i, weight, term); });
}

}  // namespace perifrac
