#pragma once

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/walls/wall_force.hpp"

namespace perifrac {

/// The one loop over pairs of fluid and wall points: sums pair(i, w, y, omega), K numbers of fluid
/// point i and near wall point w, y [m] from i to w, and hands over of_fluid(i, sum) for every
/// fluid point that is near a wall and of_wall(w, sum) for every near wall point. Each pair is
/// found twice, so that no two threads write the same; i and w may be images.
template <int K, int D, class Pair, class OfFluid, class OfWall>
void sum_wall_pairs(const FluidStep<D>& step, const NearWalls<D>& walls, Pair&& pair,
                    OfFluid&& of_fluid, OfWall&& of_wall) {
  const FluidPoints<D>& points = step.points;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  for_each_point(points.count, [&](Index i) {
    if (near.offset[i] == near.offset[i + 1]) return;
    of_fluid(i, sum_over_neighbours<K, D>(near, i, points.at(i), walls.position, step.influence,
                                          [&](Index w, const Vector<D>& y, double omega) {
                                            return pair(i, w, y, omega);
                                          }));
  });
  for_each_point(walls.count, [&](Index w) {
    of_wall(w, sum_over_neighbours<K, D>(step.neighbours.fluid_of_walls(), w, walls.at(w),
                                         points.position, step.influence,
                                         [&](Index i, Vector<D> y, double omega) {
                                           for (double& component : y) component = -component;
                                           return pair(i, w, y, omega);
                                         }));
  });
}

/// Of a wall point on a fluid point, beside one another: force [N] and heat of friction [W].
template <int D>
using WallPair = std::array<double, D + 1>;

/// Adds pair(i, w, y, omega), a WallPair, to what every fluid point has, and sets the opposite
/// force on every near wall point.
template <int D, class Pair>
void add_pair_forces(const FluidStep<D>& step, NearWalls<D>& walls, FluidForces<D>& forces,
                     Pair&& pair) {
  for (auto& values : walls.force) values.resize(walls.count);
  sum_wall_pairs<D + 1, D>(
      step, walls, pair,
      [&](Index i, const WallPair<D>& sum) {
        for (int a = 0; a < D; ++a) forces.force[a][i] += sum[a];
        if (forces.finds_heat) forces.heat[i] += sum[D];
      },
      [&](Index w, const WallPair<D>& sum) {
        for (int a = 0; a < D; ++a) walls.force[a][w] = -sum[a];
      });
}

/// The stress -p M^-1 of fluid point i times y.
template <int D>
Vector<D> stress_along(const FluidStep<D>& step, Index i, const Vector<D>& y) {
  Vector<D> result{};
  for (int a = 0; a < D; ++a) {
    for (int b = 0; b < D; ++b) {
      result[a] += step.stress[symmetric_index<D>(std::min(a, b), std::max(a, b))][i] * y[b];
    }
  }
  return result;
}

/// The drag of walls on fluid points.
template <int D>
class WallDrag {
 public:
  /// Both must stay.
  WallDrag(const FluidStep<D>& step, const NearWalls<D>& walls)
      : step_(step),
        walls_(walls),
        viscosity_(4.0 * D *
                   std::max(step.fluid.viscosity, step.fluid.density * step.scheme.wall_viscosity *
                                                      step.fluid.sound_speed() *
                                                      step.scheme.spacing)) {}

  /// That of wall point w on fluid point i over omega V_i V_w, y [m] from i to w; 0 where the wall
  /// slips. Velocities are mirrored at the surface: linear between the two points, the wall's own
  /// in between.
  Vector<D> operator()(Index i, Index w, const Vector<D>& y) const {
    const Index wall = walls_.wall[w];
    if (step_.cloud.slips[wall]) return {};
    const Vector<D> normal = vector_at(step_.cloud.normal, wall);
    const Vector<D> relative = vector_at(step_.points.velocity, i) - vector_at(walls_.velocity, w);
    const double depth = step_.cloud.depth[wall];
    double height = -depth;
    for (int a = 0; a < D; ++a) height -= normal[a] * y[a];
    height = std::max(height, 0.5 * step_.scheme.spacing);
    const double factor = viscosity_ * (height + depth) /
                          (height * (step_.moments.trace[i] + step_.moments.bulk_trace));
    return -factor * (relative - dot(normal, relative) * normal);
  }

  /// `pressed`, the force by pressure of wall point w on fluid point i over omega V_i V_w, with the
  /// drag and its heat.
  WallPair<D> beside(const Vector<D>& pressed, Index i, Index w, const Vector<D>& y,
                     double volumes) const {
    const Vector<D> drag = (*this)(i, w, y);
    const Vector<D> relative = vector_at(step_.points.velocity, i) - vector_at(walls_.velocity, w);
    WallPair<D> pair;
    for (int a = 0; a < D; ++a) pair[a] = volumes * (pressed[a] + drag[a]);
    pair[D] = -volumes * dot(drag, relative);
    return pair;
  }

 private:
  const FluidStep<D>& step_;
  const NearWalls<D>& walls_;
  double viscosity_;  ///< 4 D times that between fluid and walls that do not slip [Pa s]
};

}  // namespace perifrac
