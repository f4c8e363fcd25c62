#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "core/base/packet.hpp"
#include "core/geometry/neighbour_values.hpp"
#include "core/geometry/neighbours.hpp"
#include "core/geometry/pair_influence.hpp"

namespace perifrac {

/// Whether a term takes a packet of neighbours at a time.
template <class Term, int D>
inline constexpr bool takes_packets =
    std::is_invocable_v<Term, const Index*, const PacketVector<D>&, const Packet&>;

/// `read(j)` takes what j[0], j[1], ... bring, their positions in front, which `term` is given too.
template <int K, int D, class Influence, class Read, class Term>
inline std::array<double, K> sum_over_packets(const Neighbours& neighbours, Index i,
                                              const Vector<D>& x, const Influence& influence,
                                              Read&& read, Term&& term) {
  // Sums stay in registers only where the loops over them are unrolled.
  std::array<Packet, K> sum;
#pragma GCC unroll 64
  for (int k = 0; k < K; ++k) sum[k] = Packet{};
  const Index begin = neighbours.offset[i], end = neighbours.offset[i + 1];
  for (Index n = begin; n < end; n += packet_size) {
    // The last packet reaches back, over neighbours taken before or those of another point.
    const Index first = std::min(n, end - packet_size);
    const Index* j = neighbours.other.data() + first;
    Index filled[packet_size];
    if (first < 0) {
      for (int l = 0; l < packet_size; ++l) filled[l] = neighbours.other[std::max(0, first + l)];
      j = filled;
    }
    const auto brought = read(j);
    PacketVector<D> y;
    Packet r_square{};
    for (int a = 0; a < D; ++a) {
      y[a] = brought[a] - x[a];
      r_square += y[a] * y[a];
    }
    const Packet omega = lanes() >= n - first ? influence(r_square) : Packet{};
    const std::array<Packet, K> t = term(j, brought, y, omega);
#pragma GCC unroll 64
    for (int k = 0; k < K; ++k) sum[k] += t[k];
  }
  return totals(sum);
}

/// As sum_over_neighbours(), of NeighbourValues: sums term(brought, y, omega).
template <int K, int D, class Values, class Influence, class Term>
inline std::array<double, K> sum_over_values(const Neighbours& neighbours, Index i,
                                             const Vector<D>& x, const Values& values,
                                             const Influence& influence, Term&& term) {
  return sum_over_packets<K, D>(
      neighbours, i, x, influence, [&](const Index* j) { return values.gather(j); },
      [&](const Index*, const typename Values::Packets& brought, const PacketVector<D>& y,
          const Packet& omega) { return term(brought, y, omega); });
}

template <int K, int D, class Influence, class Term>
inline std::array<double, K> sum_one_by_one(const Neighbours& neighbours, Index i,
                                            const Vector<D>& x,
                                            const std::array<std::vector<double>, D>& position,
                                            const Influence& influence, Term&& term) {
  std::array<double, K> sum{};
  const Index end = neighbours.offset[i + 1];
  for (Index n = neighbours.offset[i]; n < end; ++n) {
    const Index j = neighbours.other[n];
    Vector<D> y;
    double r_square = 0.0;
    for (int a = 0; a < D; ++a) {
      y[a] = position[a][j] - x[a];
      r_square += y[a] * y[a];
    }
    const double omega = influence(r_square);
    if (omega == 0.0) continue;
    const std::array<double, K> t = term(j, y, omega);
    for (int k = 0; k < K; ++k) sum[k] += t[k];
  }
  return sum;
}

/// The sum over the neighbours of a point at `x` of term(j, y, omega): j the neighbour, y the
/// vector to it [m].
///
/// For the loops that most time goes into, a term may take a packet of neighbours at a time, as
/// `(const Index* j, const PacketVector<D>& y, const Packet& omega)`: j points to their indices,
/// for gather(values, j). A packet may hold more than the list does. What is surplus, or beyond the
/// horizon, has omega = 0, and every part of a term must have it as a factor.
template <int K, int D, class Influence, class Term>
inline std::array<double, K> sum_over_neighbours(const Neighbours& neighbours, Index i,
                                                 const Vector<D>& x,
                                                 const std::array<std::vector<double>, D>& position,
                                                 const Influence& influence, Term&& term) {
  if constexpr (std::is_same_v<Influence, PairInfluence>) {
    return influence.with([&](const auto& own) {
      return sum_over_neighbours<K, D>(neighbours, i, x, position, own, term);
    });
  } else if constexpr (takes_packets<Term, D>) {
    return sum_over_packets<K, D>(
        neighbours, i, x, influence,
        [&](const Index* j) {
          PacketVector<D> at;
          for (int a = 0; a < D; ++a) at[a] = gather(position[a], j);
          return at;
        },
        [&](const Index* j, const PacketVector<D>&, const PacketVector<D>& y, const Packet& omega) {
          return term(j, y, omega);
        });
  } else {
    return sum_one_by_one<K, D>(neighbours, i, x, position, influence, term);
  }
}

}  // namespace perifrac
