#include "modules/fluid/points/fluid_moments.hpp"

#include <array>
#include <cmath>

namespace perifrac {

namespace {

/// Sum of omega V term(r^2) over an endless lattice.
template <int D, class Term>
double lattice_sum(double spacing, double horizon, const PairInfluence& influence, Term&& term) {
  const int reach = static_cast<int>(horizon / spacing) + 1;
  double sum = 0.0;
  std::array<int, 3> k{};
  const int depth = D == 3 ? reach : 0;
  for (k[0] = -reach; k[0] <= reach; ++k[0]) {
    for (k[1] = -reach; k[1] <= reach; ++k[1]) {
      for (k[2] = -depth; k[2] <= depth; ++k[2]) {
        const double square = (k[0] * k[0] + k[1] * k[1] + k[2] * k[2]) * spacing * spacing;
        sum += influence(square) * term(square);
      }
    }
  }
  return sum * std::pow(spacing, D);
}

}  // namespace

template <int D>
double lattice_trace(double spacing, double horizon, const PairInfluence& influence) {
  return lattice_sum<D>(spacing, horizon, influence, [](double square) { return square; });
}

template <int D>
double lattice_weight(double spacing, double horizon, const PairInfluence& influence) {
  return lattice_sum<D>(spacing, horizon, influence,
                        [](double square) { return square > 0.0 ? 1.0 : 0.0; });
}

template double lattice_trace<2>(double, double, const PairInfluence&);
template double lattice_trace<3>(double, double, const PairInfluence&);
template double lattice_weight<2>(double, double, const PairInfluence&);
template double lattice_weight<3>(double, double, const PairInfluence&);

}  // namespace perifrac
