#include "modules/fluid/bond_flux_exchange.hpp"

#include "core/operators/bond_traversal.hpp"

namespace perifrac {

namespace {

template <int D>
Positions<D> spans(const std::array<std::vector<double>, D>& position) {
  Positions<D> result;
  for (int a = 0; a < D; ++a) result[a] = position[a];
  return result;
}

/// omega r^2 V
template <int D>
double moment(const Vector<D>& y, double weight) {
  double square = 0.0;
  for (int a = 0; a < D; ++a) square += y[a] * y[a];
  return weight * square;
}

template <int D>
Vector<D> near_wall_at(const NearWalls<D>& walls, Index w) {
  Vector<D> x;
  for (int a = 0; a < D; ++a) x[a] = walls.position[a][w];
  return x;
}

}  // namespace

template <int D>
BondFluxExchange<D>::BondFluxExchange(const Body<D>& body, const WallCloud<D>& cloud,
                                      std::span<const RigidWall<D>> rigid, const Period<D>& period,
                                      double horizon)
    : solid_moment_(cloud.size()) {
  std::array<std::vector<double>, D> position = body.points().position;
  std::vector<double> volume = body.points().volume;
  for (Index w = 0; w < cloud.rigid_count; ++w) {
    if (rigid[cloud.owner[w]].motion != RigidWall<D>::Motion::fixed) continue;
    for (int a = 0; a < D; ++a) position[a].push_back(cloud.position[a][w]);
    volume.push_back(cloud.volume[w]);
  }
  const Index count = static_cast<Index>(volume.size());
  PeriodicImages<D> images;
  images.find(period, position, count, horizon);
  images.copy_positions(position, count);
  images.copy(volume, count);

  CellGrid<D> grid;
  Neighbours neighbours;
  grid.build(spans<D>(position), horizon);
  grid.find_others(body.points().size(), horizon, neighbours);
  const GaussianInfluence influence(horizon);
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    const Index i = cloud.owner[w];
    solid_moment_[w] =
        sum_over_neighbours<1, D>(neighbours, i, body.points().at(i), position, influence,
                                  [&](Index j, const Vector<D>& y, double omega) {
                                    return std::array{moment<D>(y, omega * volume[j])};
                                  })[0];
  }
}

template <int D>
double BondFluxExchange<D>::flux(const FluidStep<D>& step, const PoreInput& pores, double t,
                                 const NearWalls<D>& walls, Index i, Index w, const Vector<D>& y,
                                 double omega) const {
  const Index wall = walls.wall[w];
  if (step.cloud.is_rigid(wall)) return 0.0;
  const Index j = step.cloud.owner[wall];
  double head = step.points.pressure[i] - pores.at(j, t);
  for (int a = 0; a < D; ++a) head += step.fluid.density * step.gravity[a] * y[a];
  const double traces = step.moments.trace[i] + solid_moment_[wall] + walls.fluid_moment[w];
  return step.fluid.density * pores.mobility[j] * 4.0 * D / traces * head * omega *
         step.points.volume[i] * walls.volume[w];
}

template <int D>
void BondFluxExchange<D>::find(const FluidStep<D>& step, const PoreInput& pores, double t,
                               NearWalls<D>& walls, std::vector<double>& rate) {
  find_fluid_moments(step, walls);
  const FluidPoints<D>& points = step.points;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  rate.assign(points.count, 0.0);
  for_each_point(points.count, [&](Index i) {
    if (near.offset[i] == near.offset[i + 1]) return;
    rate[i] =
        -sum_over_neighbours<1, D>(near, i, points.at(i), walls.position, step.influence,
                                   [&](Index w, const Vector<D>& y, double omega) {
                                     return std::array{flux(step, pores, t, walls, i, w, y, omega)};
                                   })[0];
  });
  walls.mass_rate.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    walls.mass_rate[w] = sum_over_neighbours<1, D>(
        step.neighbours.fluid_of_walls(), w, near_wall_at<D>(walls, w), points.position,
        step.influence, [&](Index i, Vector<D> y, double omega) {
          for (double& component : y) component = -component;
          return std::array{flux(step, pores, t, walls, i, w, y, omega)};
        })[0];
  });
}

template <int D>
void find_fluid_moments(const FluidStep<D>& step, NearWalls<D>& walls) {
  walls.fluid_moment.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    if (step.cloud.is_rigid(walls.wall[w])) return;
    walls.fluid_moment[w] = sum_over_neighbours<1, D>(
        step.neighbours.fluid_of_walls(), w, near_wall_at<D>(walls, w), step.points.position,
        step.influence, [&](Index i, const Vector<D>& y, double omega) {
          return std::array{moment<D>(y, omega * step.points.volume[i])};
        })[0];
  });
  step.neighbours.wall_images().copy(walls.fluid_moment, walls.count);
}

template class BondFluxExchange<2>;
template class BondFluxExchange<3>;
template void find_fluid_moments<2>(const FluidStep<2>&, NearWalls<2>&);
template void find_fluid_moments<3>(const FluidStep<3>&, NearWalls<3>&);

}  // namespace perifrac
