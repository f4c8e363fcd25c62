#include "modules/fluid/walls/two_sided_wall_force.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "modules/fluid/walls/wall_pairs.hpp"

namespace perifrac {

namespace {

/// The force by pressure of wall point w on fluid point i, y from i to w, over omega V_i V_w.
template <int D>
Vector<D> pressed(const FluidStep<D>& step, const NearWalls<D>& walls, Index i, Index w,
                  const Vector<D>& y) {
  const double bulk = step.moments.bulk_trace / D;
  const Vector<D> stress =
      step.points.pressure[i] > 0.0 ? stress_along<D>(step, i, y) : Vector<D>{};
  return stress - walls.pressure[w] / bulk * y;
}

}  // namespace

template <int D>
void TwoSidedWallForce<D>::extrapolate_pressure(const FluidStep<D>& step,
                                                NearWalls<D>& walls) const {
  const FluidPoints<D>& points = step.points;
  walls.pressure.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    const auto [weighted, weights] = sum_over_neighbours<2, D>(
        step.neighbours.fluid_of_walls(), w, walls.at(w), points.position, step.influence,
        [&](Index j, const Vector<D>& y, double omega) {
          const double depth = -dot(step.gravity, y);
          const double weight = omega * points.volume[j];
          return std::array{weight * (points.pressure[j] + points.density[j] * depth), weight};
        });
    walls.pressure[w] = weights > 0.0 ? std::max(0.0, weighted / weights) : 0.0;
  });
  step.neighbours.wall_images().copy(walls.pressure, walls.count);
}

template <int D>
void TwoSidedWallForce<D>::add(const FluidStep<D>& step, NearWalls<D>& walls,
                               FluidForces<D>& forces) {
  extrapolate_pressure(step, walls);
  const WallDrag<D> drag(step, walls);
  add_pair_forces<D>(step, walls, forces, [&](Index i, Index w, const Vector<D>& y, double omega) {
    const double volumes = omega * step.points.volume[i] * walls.volume[w];
    return drag.beside(pressed<D>(step, walls, i, w, y), i, w, y, volumes);
  });
}

template class TwoSidedWallForce<2>;
template class TwoSidedWallForce<3>;

}  // namespace perifrac
