#include "modules/fluid/two_sided_wall_force.hpp"

#include <algorithm>

#include "core/operators/bond_traversal.hpp"

namespace perifrac {

namespace {

/// Dynamic, between fluid and walls that do not slip [Pa s].
template <int D>
double wall_viscosity(const FluidStep<D>& step) {
  return std::max(step.fluid.viscosity, step.fluid.density * step.scheme.wall_viscosity *
                                            step.fluid.sound_speed() * step.scheme.spacing);
}

/// The force of wall point w on fluid point i, y from i to w.
template <int D>
Vector<D> pair_force(const FluidStep<D>& step, const NearWalls<D>& walls, Index i, Index w,
                     const Vector<D>& y, double omega) {
  const FluidPoints<D>& points = step.points;
  const double bulk = step.moments.bulk_trace / D;
  const double volumes = omega * points.volume[i] * walls.volume[w];
  Vector<D> force;
  for (int a = 0; a < D; ++a) {
    double stress = -walls.pressure[w] / bulk * y[a];
    for (int b = 0; b < D && points.pressure[i] > 0.0; ++b) {
      stress += step.stress[symmetric_index<D>(std::min(a, b), std::max(a, b))][i] * y[b];
    }
    force[a] = volumes * stress;
  }
  const Index wall = walls.wall[w];
  if (step.cloud.slips[wall]) return force;
  // Velocities mirrored at the surface: linear between the two points, the wall's own in between.
  double height = -step.cloud.depth[wall];
  double along_normal = 0.0;
  Vector<D> normal, relative;
  for (int a = 0; a < D; ++a) {
    normal[a] = step.cloud.normal[a][wall];
    relative[a] = points.velocity[a][i] - walls.velocity[a][w];
    height -= normal[a] * y[a];
    along_normal += normal[a] * relative[a];
  }
  const double steepness =
      1.0 + step.cloud.depth[wall] / std::max(height, 0.5 * step.scheme.spacing);
  const double drag = volumes * wall_viscosity(step) * 4.0 * D /
                      (step.moments.trace[i] + step.moments.bulk_trace) * steepness;
  for (int a = 0; a < D; ++a) force[a] -= drag * (relative[a] - along_normal * normal[a]);
  return force;
}

}  // namespace

template <int D>
void TwoSidedWallForce<D>::extrapolate_pressure(const FluidStep<D>& step,
                                                NearWalls<D>& walls) const {
  const FluidPoints<D>& points = step.points;
  walls.pressure.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = walls.position[a][w];
    const auto [weighted, weights] = sum_over_neighbours<2, D>(
        step.neighbours.fluid_of_walls(), w, x, points.position, step.influence,
        [&](Index j, const Vector<D>& y, double omega) {
          double depth = 0.0;
          for (int a = 0; a < D; ++a) depth -= step.gravity[a] * y[a];
          const double weight = omega * points.volume[j];
          return std::array{weight * (points.pressure[j] + points.density[j] * depth), weight};
        });
    walls.pressure[w] = weights > 0.0 ? std::max(0.0, weighted / weights) : 0.0;
  });
  step.neighbours.wall_images().copy(walls.pressure, walls.count);
}

template <int D>
void TwoSidedWallForce<D>::add(const FluidStep<D>& step, NearWalls<D>& walls,
                               std::array<std::vector<double>, D>& force) {
  extrapolate_pressure(step, walls);
  const FluidPoints<D>& points = step.points;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  for_each_point(points.count, [&](Index i) {
    if (near.offset[i] == near.offset[i + 1]) return;
    const auto sum =
        sum_over_neighbours<D, D>(near, i, points.at(i), walls.position, step.influence,
                                  [&](Index w, const Vector<D>& y, double omega) {
                                    return pair_force<D>(step, walls, i, w, y, omega);
                                  });
    for (int a = 0; a < D; ++a) force[a][i] += sum[a];
  });
  for (auto& values : walls.force) values.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = walls.position[a][w];
    const auto sum =
        sum_over_neighbours<D, D>(step.neighbours.fluid_of_walls(), w, x, points.position,
                                  step.influence, [&](Index i, Vector<D> y, double omega) {
                                    for (double& component : y) component = -component;
                                    return pair_force<D>(step, walls, i, w, y, omega);
                                  });
    for (int a = 0; a < D; ++a) walls.force[a][w] = -sum[a];
  });
}

template class TwoSidedWallForce<2>;
template class TwoSidedWallForce<3>;

}  // namespace perifrac
