#include "modules/fluid/as_published/smoothed_exchange.hpp"

#include "modules/fluid/exchange/pair_exchange.hpp"

namespace perifrac {

template <int D>
SmoothedExchange<D>::SmoothedExchange(std::unique_ptr<Exchange<D>> exchange, double coefficient,
                                      double spacing, double horizon,
                                      const PairInfluence& influence)
    : exchange_(std::move(exchange)),
      coefficient_(coefficient / (spacing * lattice_weight<D>(spacing, horizon, influence))) {}

template <int D>
void SmoothedExchange<D>::find(const FluidStep<D>& step, const PoreInput& pores, double t,
                               NearWalls<D>& walls, std::vector<double>& rate) {
  exchange_->find(step, pores, t, walls, rate);
  const double scale =
      coefficient_ * step.fluid.sound_speed() * step.fluid.density / step.fluid.bulk_modulus;
  add_pair_flux(step, walls, rate, [&](Index i, Index w, const Vector<D>& y, double omega) {
    return scale * omega * head<D>(step, pores, t, walls, i, w, y) * step.points.volume[i] *
           walls.volume[w];
  });
}

template class SmoothedExchange<2>;
template class SmoothedExchange<3>;

}  // namespace perifrac
