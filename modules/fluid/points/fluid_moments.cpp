#include "modules/fluid/points/fluid_moments.hpp"

#include <array>
#include <cmath>

namespace perifrac {

template <int D>
double lattice_trace(double spacing, double horizon, const PairInfluence& influence) {
  const int reach = static_cast<int>(horizon / spacing) + 1;
  double sum = 0.0;
  std::array<int, 3> k{};
  const int depth = D == 3 ? reach : 0;
  for (k[0] = -reach; k[0] <= reach; ++k[0]) {
    for (k[1] = -reach; k[1] <= reach; ++k[1]) {
      for (k[2] = -depth; k[2] <= depth; ++k[2]) {
        const double square = (k[0] * k[0] + k[1] * k[1] + k[2] * k[2]) * spacing * spacing;
        sum += influence(square) * square;
      }
    }
  }
  return sum * std::pow(spacing, D);
}

template double lattice_trace<2>(double, double, const PairInfluence&);
template double lattice_trace<3>(double, double, const PairInfluence&);

}  // namespace perifrac
