#pragma once

#include <algorithm>
#include <type_traits>
#include <vector>

#include "core/geometry/neighbours.hpp"
#include "core/operators/gaussian_influence.hpp"
#include "core/operators/packet.hpp"

namespace perifrac {

/// A term that takes a packet of neighbours at a time.
template <class Term, int D>
concept PacketTerm = std::is_invocable_v < Term,
        const Index*, const PacketVector<D>
&, const Packet& > ;

/// The one loop over the neighbours of a point at `x`: the sum over them of term(j, y, omega),
/// where y is the vector to the neighbour [m]. Takes a packet of neighbours at a time: j points to
/// their indices, for gather(values, j). A packet may hold more than the list: what is surplus, or
/// beyond the horizon, has omega = 0, and every part of a term must have it as a factor.
template <int K, int D, PacketTerm<D> Term>
inline std::array<double, K> sum_over_neighbours(const Neighbours& neighbours, Index i,
                                                 const Vector<D>& x,
                                                 const std::array<std::vector<double>, D>& position,
                                                 const GaussianInfluence& influence, Term&& term) {
  Packet sum[K] = {};
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
    PacketVector<D> y;
    Packet r_square{};
    for (int a = 0; a < D; ++a) {
      y[a] = gather(position[a], j) - x[a];
      r_square += y[a] * y[a];
    }
    const Packet omega = lanes() >= n - first ? influence(r_square) : Packet{};
    const std::array<Packet, K> t = term(j, y, omega);
    for (int k = 0; k < K; ++k) sum[k] += t[k];
  }
  std::array<double, K> result;
  for (int k = 0; k < K; ++k) result[k] = total(sum[k]);
  return result;
}

/// The same for a term that must take neighbours one by one: j is the neighbour.
template <int K, int D, class Term>
requires(!PacketTerm<Term, D>) inline std::array<double, K> sum_over_neighbours(
    const Neighbours& neighbours, Index i, const Vector<D>& x,
    const std::array<std::vector<double>, D>& position, const GaussianInfluence& influence,
    Term&& term) {
  std::array<double, K> sum{};
  const Index end = neighbours.offset[i + 1];
  for (Index k = neighbours.offset[i]; k < end; ++k) {
    const Index j = neighbours.other[k];
    Vector<D> y;
    double r_square = 0.0;
    for (int a = 0; a < D; ++a) {
      y[a] = position[a][j] - x[a];
      r_square += y[a] * y[a];
    }
    const std::array<double, K> t = term(j, y, influence(r_square));
    for (int c = 0; c < K; ++c) sum[c] += t[c];
  }
  return sum;
}

}  // namespace perifrac
