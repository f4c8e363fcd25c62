#include "modules/fluid/particle_shifting.hpp"

#include <algorithm>
#include <cmath>

#include "core/operators/bond_traversal.hpp"

namespace perifrac {

namespace {

// Part of a lattice's shape tensor: of a flat surface .64, of the row below it .95.
constexpr double surface = 0.8;
constexpr double inside = 0.95;
constexpr double longest = 0.1;  // of a spacing

}  // namespace

template <int D>
void shift_points(double strength, double length, double spacing, const FluidMoments<D>& moments,
                  FluidPoints<D>& points) {
  for_each_point(points.count, [&](Index i) {
    const double part = moments.trace[i] / moments.bulk_trace;
    if (part <= surface) return;
    double speed = 0.0, crowding = 0.0;
    for (int a = 0; a < D; ++a) {
      speed += points.velocity[a][i] * points.velocity[a][i];
      crowding += moments.crowding[a][i] * moments.crowding[a][i];
    }
    if (crowding == 0.0) return;
    crowding = std::sqrt(crowding);
    const double inwards = std::min(1.0, (part - surface) / (inside - surface));
    const double way = std::min(strength * length * std::sqrt(speed) * inwards * spacing * crowding,
                                longest * spacing);
    for (int a = 0; a < D; ++a) {
      points.position[a][i] -= way * moments.crowding[a][i] / crowding;
    }
  });
}

template void shift_points<2>(double, double, double, const FluidMoments<2>&, FluidPoints<2>&);
template void shift_points<3>(double, double, double, const FluidMoments<3>&, FluidPoints<3>&);

}  // namespace perifrac
