#include "modules/fluid/exchange/bond_flux_exchange.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "modules/fluid/exchange/pair_exchange.hpp"
#include "modules/fluid/walls/body_neighbours.hpp"

namespace perifrac {

namespace {

/// omega r^2 V
template <int D>
std::array<double, 1> moment(const Vector<D>& y, double weight) {
  return {weight * squared_norm(y)};
}

template <int D>
std::vector<Index> points_at_rest(const WallCloud<D>& cloud, std::span<const RigidWall<D>> rigid) {
  std::vector<Index> result;
  for (Index w = 0; w < cloud.rigid_count; ++w) {
    if (rigid[cloud.owner[w]].motion == RigidWall<D>::Motion::fixed) result.push_back(w);
  }
  return result;
}

/// Sets the fluid's share in tr M of every near wall point that is the body's.
template <int D>
void find_fluid_moments(const FluidStep<D>& step, NearWalls<D>& walls) {
  walls.fluid_moment.resize(walls.count);
  for_each_point(walls.count, [&](Index w) {
    if (step.cloud.is_rigid(walls.wall[w])) return;
    walls.fluid_moment[w] = sum_over_neighbours<1, D>(
        step.neighbours.fluid_of_walls(), w, walls.at(w), step.points.position, step.influence,
        [&](Index i, const Vector<D>& y, double omega) {
          return moment<D>(y, omega * step.points.volume[i]);
        })[0];
  });
  step.neighbours.wall_images().copy(walls.fluid_moment, walls.count);
}

}  // namespace

template <int D>
BondFluxExchange<D>::BondFluxExchange(const Body<D>& body, const WallCloud<D>& cloud,
                                      std::span<const RigidWall<D>> rigid, const Period<D>& period,
                                      double horizon, const PairInfluence& influence)
    : solid_moment_(cloud.size()), inverse_depth_(cloud.size()) {
  const BodyNeighbours<D> solid(body, cloud, points_at_rest<D>(cloud, rigid), period, horizon);
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    solid_moment_[w] =
        sum_over_neighbours<1, D>(solid.near, w, body.points().at(cloud.owner[w]), solid.position,
                                  influence, [&](Index j, const Vector<D>& y, double omega) {
                                    return moment<D>(y, omega * solid.volume[j]);
                                  })[0];
    // In a cloud points may lie arbitrarily close to the surface.
    const double depth = std::max(cloud.depth[w], 0.25 * body.spacing());
    if (depth < body.spacing()) inverse_depth_[w] = 1.0 / depth;
  }
}

template <int D>
void BondFluxExchange<D>::find(const FluidStep<D>& step, const PoreInput& pores, double t,
                               double /*length*/, NearWalls<D>& walls, std::vector<double>& rate) {
  find_fluid_moments(step, walls);
  add_pair_flux(step, walls, rate, [&](Index i, Index w, const Vector<D>& y, double omega) {
    const Index wall = walls.wall[w];
    if (inverse_depth_[wall] == 0.0) return 0.0;
    double height = -step.cloud.depth[wall];
    for (int a = 0; a < D; ++a) height -= step.cloud.normal[a][wall] * y[a];
    const double steepness = 1.0 + std::max(0.0, height) * inverse_depth_[wall];
    const double traces = step.moments.trace[i] + solid_moment_[wall] + walls.fluid_moment[w];
    return step.fluid.density * pores.mobility[step.cloud.owner[wall]] * 4.0 * D / traces *
           steepness * omega * head<D>(step, pores, t, walls, i, w, y) * step.points.volume[i] *
           walls.volume[w];
  });
}

template class BondFluxExchange<2>;
template class BondFluxExchange<3>;

}  // namespace perifrac
