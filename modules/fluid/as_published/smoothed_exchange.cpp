#include "modules/fluid/as_published/smoothed_exchange.hpp"

#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/exchange/pair_exchange.hpp"

namespace perifrac {

template <int D>
SmoothedExchange<D>::SmoothedExchange(std::unique_ptr<Exchange<D>> exchange, double coefficient,
                                      const Body<D>& body, const WallCloud<D>& cloud,
                                      const Period<D>& period, double horizon,
                                      const PairInfluence& influence)
    : exchange_(std::move(exchange)), coefficient_(coefficient), body_weight_(cloud.size()) {
  const BodyNeighbours<D> solid(body, cloud, {}, period, horizon);
  for (Index w = cloud.rigid_count; w < cloud.size(); ++w) {
    body_weight_[w] =
        sum_over_neighbours<1, D>(solid.near, w, cloud.at(w), solid.position, influence,
                                  [&](Index k, const Vector<D>&, double omega) {
                                    return std::array{omega * solid.volume[k]};
                                  })[0];
  }
}

template <int D>
void SmoothedExchange<D>::find(const FluidStep<D>& step, const PoreInput& pores, double t,
                               double length, NearWalls<D>& walls, std::vector<double>& rate) {
  exchange_->find(step, pores, t, length, walls, rate);
  uptake_.assign(walls.count, 0.0);
  for_each_point(walls.count, [&](Index w) {
    const Index wall = walls.wall[w];
    if (step.cloud.is_rigid(wall)) return;
    const double slope = pores.slope[step.cloud.owner[wall]];
    if (!(slope > 0.0)) return;
    const double weights =
        body_weight_[wall] +
        coefficient_ * sum_over_neighbours<1, D>(step.neighbours.fluid_of_walls(), w, walls.at(w),
                                                 step.points.position, step.influence,
                                                 [&](Index i, const Vector<D>&, double omega) {
                                                   return std::array{omega * step.points.volume[i]};
                                                 })[0];
    uptake_[w] = coefficient_ / (weights * slope * length);
  });
  step.neighbours.wall_images().copy(uptake_, walls.count);
  add_pair_flux(step, walls, rate, [&](Index i, Index w, const Vector<D>& y, double omega) {
    return uptake_[w] * omega * step.points.volume[i] * head<D>(step, pores, t, walls, i, w, y);
  });
}

template class SmoothedExchange<2>;
template class SmoothedExchange<3>;

}  // namespace perifrac
