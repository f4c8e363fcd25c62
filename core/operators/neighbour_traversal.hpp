#pragma once

#include <array>
#include <cmath>

#include "core/geometry/neighbours.hpp"
#include "core/geometry/points.hpp"

namespace perifrac {

/// The Gaussian influence omega(r^2) = exp(-(r / 0.4 horizon)^2), 0 from the horizon on.
struct GaussianInfluence {
  explicit GaussianInfluence(double horizon)
      : horizon_square(horizon * horizon), scale(-1.0 / (0.16 * horizon * horizon)) {}

  double operator()(double r_square) const {
    return r_square < horizon_square ? std::exp(scale * r_square) : 0.0;
  }

  double horizon_square;
  double scale;
};

/// The one loop over the neighbours of a point at `x`: the sum over them of
/// term(j, y, omega), where y is the vector to the neighbour [m].
template <int K, int D, class Term>
inline std::array<double, K> sum_over_neighbours(const Neighbours& neighbours, Index i,
                                                 const Vector<D>& x,
                                                 const std::array<std::vector<double>, D>& position,
                                                 const GaussianInfluence& influence, Term&& term) {
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
