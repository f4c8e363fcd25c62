#pragma once

#include "modules/fluid/exchange/exchange.hpp"
#include "modules/fluid/walls/wall_pairs.hpp"

namespace perifrac {

/// Adds what flows between all pairs of fluid points and points of the body: what one loses the
/// other gets, and the momentum that it has at the fluid point's velocity. flux(i, w, y, omega) is
/// what passes from fluid point i into near wall point w [kg/s], y from i to w [m].
template <int D, class Flux>
void add_pair_flux(const FluidStep<D>& step, NearWalls<D>& walls, std::vector<double>& rate,
                   Flux&& flux) {
  using Sum = std::array<double, 1 + D>;
  sum_wall_pairs<1 + D, D>(
      step, walls,
      [&](Index i, Index w, const Vector<D>& y, double omega) {
        Sum term{};
        if (step.cloud.is_rigid(walls.wall[w])) return term;
        term[0] = flux(i, w, y, omega);
        for (int a = 0; a < D; ++a) term[1 + a] = term[0] * step.points.velocity[a][i];
        return term;
      },
      [&](Index i, const Sum& sum) { rate[i] -= sum[0]; },
      [&](Index w, const Sum& sum) {
        walls.mass_rate[w] += sum[0];
        for (int a = 0; a < D; ++a) walls.momentum_rate[a][w] += sum[1 + a];
      });
}

/// p_i - p_w - rho_0 g.(x_i - x_w) [Pa] between fluid point i and the pores at near wall point w.
template <int D>
double head(const FluidStep<D>& step, const PoreInput& pores, double t, const NearWalls<D>& walls,
            Index i, Index w, const Vector<D>& y) {
  double head = step.points.pressure[i] - pores.at(step.cloud.owner[walls.wall[w]], t);
  for (int a = 0; a < D; ++a) head += step.fluid.density * step.gravity[a] * y[a];
  return head;
}

}  // namespace perifrac
