#include "modules/fluid/points/split_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

/// The square of the distance from x to the nearest of the points that the list of i names.
template <int D>
double nearest(const Neighbours& neighbours, Index i, const Vector<D>& x,
               const std::array<std::vector<double>, D>& position) {
  double least = std::numeric_limits<double>::infinity();
  for (Index k = neighbours.offset[i]; k < neighbours.offset[i + 1]; ++k) {
    least = std::min(least, squared_norm(vector_at(position, neighbours.other[k]) - x));
  }
  return least;
}

/// Half the way between the two that point i becomes.
template <int D>
Vector<D> best_half_distance(const FluidPoints<D>& points, const NearWalls<D>& walls,
                             const FluidNeighbours<D>& neighbours, Index i) {
  const Vector<D> x = points.at(i);
  const double half = 0.5 * std::pow(0.5 * points.mass[i] / points.density[i], 1.0 / D);
  Vector<D> best{};
  double most_room = -1.0;
  // Directions of {-1, 0, 1}^D, one of each opposite pair.
  for (int number = (D == 2 ? 9 : 27) / 2 + 1; number < (D == 2 ? 9 : 27); ++number) {
    Vector<D> e;
    double square = 0.0;
    for (int a = 0, rest = number; a < D; ++a, rest /= 3) {
      e[a] = rest % 3 - 1;
      square += e[a] * e[a];
    }
    for (double& component : e) component *= half / std::sqrt(square);
    double room = std::numeric_limits<double>::infinity();
    for (const double side : {-1.0, 1.0}) {
      const Vector<D> there = x + side * e;
      // Walls do not give way: they count as twice as near.
      room = std::min({room, nearest<D>(neighbours.fluid_of_fluid(), i, there, points.position),
                       0.25 * nearest<D>(neighbours.walls_of_fluid(), i, there, walls.position)});
    }
    if (room > most_room) best = e, most_room = room;
  }
  return best;
}

}  // namespace

template <int D>
Index split_points(FluidPoints<D>& points, const NearWalls<D>& walls,
                   const FluidNeighbours<D>& neighbours, double most) {
  std::vector<std::pair<Index, Vector<D>>> heavy;
  for (Index i = 0; i < points.count; ++i) {
    if (points.mass[i] <= most) continue;
    heavy.emplace_back(i, best_half_distance<D>(points, walls, neighbours, i));
  }
  for (const auto& [i, half] : heavy) {
    const Vector<D> x = points.at(i);
    const Vector<D> v = vector_at(points.velocity, i);
    points.mass[i] *= 0.5;
    set_at(points.position, i, x + half);
    points.add(x - half, v, points.density[i], points.mass[i]);
  }
  return static_cast<Index>(heavy.size());
}

template Index split_points<2>(FluidPoints<2>&, const NearWalls<2>&, const FluidNeighbours<2>&,
                               double);
template Index split_points<3>(FluidPoints<3>&, const NearWalls<3>&, const FluidNeighbours<3>&,
                               double);

}  // namespace perifrac
