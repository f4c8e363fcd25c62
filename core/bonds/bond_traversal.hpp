#pragma once

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

#include "core/base/for_each_point.hpp"
#include "core/base/packet.hpp"
#include "core/bonds/family.hpp"
#include "core/geometry/neighbour_values.hpp"

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

/// N numbers of every node, each in an array of its own, read when they are asked for.
template <int N>
struct NodeColumns {
  std::array<const double*, N> column;

  struct At {
    const NodeColumns& of;
    Index node;
    double operator[](int k) const { return of.column[k][node]; }
  };
};

inline Packet load_weights(const double* weight, Index k) { return load(weight + k); }
inline Packet load_weights(const BondWeights::Packed& weight, Index k) {
  return [&]<int... l>(std::integer_sequence<int, l...>) { return Packet{weight[k + l]...}; }
  (std::make_integer_sequence<int, packet_size>{});
}

/// Of a packet of the bonds of point i, from the k-th on, the other ends `j` and the weights: 0 for
/// the first that an earlier packet had, `taken` of them. k < 0: there are fewer than a packet
/// holds; the last is repeated, without weight.
template <class Weight>
[[gnu::always_inline]] inline Packet take_bonds(Index i, std::span<const Index> steps,
                                                const Weight& weight, Index k, Index taken,
                                                Index* j) {
  const Index count = static_cast<Index>(steps.size());
  if (k >= 0) [[likely]] {
    for (int l = 0; l < packet_size; ++l) j[l] = i + steps[k + l];
    const Packet w = load_weights(weight, k);
    return taken == 0 ? w : lanes() >= taken ? w : Packet{};
  }
  Packet w{};
  for (int l = 0; l < packet_size; ++l) {
    j[l] = i + steps[std::min(l, count - 1)];
    if (l < count) w[l] = weight[l];
  }
  return w;
}

template <int K, int used, int D, class Weight, int N, class Term>
[[gnu::always_inline]] inline std::array<double, K> sum_packets(const Family<D>& family, Index i,
                                                                const Weight& weight,
                                                                const NeighbourRows<N>& values,
                                                                Term&& term) {
  // Sums stay in registers only where the loops over them are unrolled.
  std::array<Packet, K> sum;
#pragma GCC unroll 64
  for (int k = 0; k < K; ++k) sum[k] = Packet{};
  Vector<D> x;
  for (int a = 0; a < D; ++a) x[a] = family.position[a][i];
  const std::span<const Index> steps = family.steps[i];
  const Index count = static_cast<Index>(steps.size());
  for (Index n = 0; n < count; n += packet_size) {
    // The last packet reaches back, over bonds taken before.
    const Index first = std::min(n, count - packet_size);
    Index j[packet_size];
    const Packet w = take_bonds(i, steps, weight, first, n - first, j);
    const auto other = values.template gather<used>(j);
    PacketVector<D> xi;
    for (int a = 0; a < D; ++a) xi[a] = other[a] - x[a];
    const std::array<Packet, K> t = term(j, other, xi, w);
#pragma GCC unroll 64
    for (int k = 0; k < K; ++k) sum[k] += t[k];
  }
  return totals(sum);
}

/// What path() of an operator says of that.
inline std::string packets_of_bonds() {
  return "packets of " + std::to_string(packet_size) + " bonds: ";
}

/// The same by values of nodes, positions in front: the sum of term(j, other, xi, weight), other[k]
/// being the k-th number of the other end, of which `used` are. Of columns bond by bond, of rows a
/// packet of bonds at a time, which is faster where there are many: then the term's numbers are
/// packets, and j points to a packet's indices.
template <int K, int used, int D, int N, class Term>
inline std::array<double, K> sum_over_bonds(const Family<D>& family, Index i,
                                            const NodeColumns<N>& values, Term&& term) {
  return sum_over_bonds<K>(family, i, [&](Index j, const Vector<D>& xi, double w) {
    return term(j, typename NodeColumns<N>::At{values, j}, xi, w);
  });
}
template <int K, int used, int D, int N, class Term>
inline std::array<double, K> sum_over_bonds(const Family<D>& family, Index i,
                                            const NeighbourRows<N>& values, Term&& term) {
  return family.weight.with(
      i, [&](const auto& weight) __attribute__((always_inline)) {
        return sum_packets<K, used>(family, i, weight, values, term);
      });
}

}  // namespace perifrac
