#pragma once

#include "core/operators/bond_traversal.hpp"
#include "modules/fluid/exchange.hpp"

namespace perifrac {

/// Adds what flows between all pairs of fluid points and points of the body: what one loses the
/// other gets, and the momentum that it has at the fluid point's velocity. flux(i, w, y, omega) is
/// what passes from fluid point i into near wall point w [kg/s], y from i to w [m].
template <int D, class Flux>
void add_pair_flux(const FluidStep<D>& step, NearWalls<D>& walls, std::vector<double>& rate,
                   Flux&& flux) {
  const FluidPoints<D>& points = step.points;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  for_each_point(points.count, [&](Index i) {
    if (near.offset[i] == near.offset[i + 1]) return;
    rate[i] -= sum_over_neighbours<1, D>(near, i, points.at(i), walls.position, step.influence,
                                         [&](Index w, const Vector<D>& y, double omega) {
                                           const bool rigid = step.cloud.is_rigid(walls.wall[w]);
                                           return std::array{rigid ? 0.0 : flux(i, w, y, omega)};
                                         })[0];
  });
  for_each_point(walls.count, [&](Index w) {
    if (step.cloud.is_rigid(walls.wall[w])) return;
    const auto sum = sum_over_neighbours<1 + D, D>(
        step.neighbours.fluid_of_walls(), w, walls.at(w), points.position, step.influence,
        [&](Index i, Vector<D> y, double omega) {
          for (double& component : y) component = -component;
          std::array<double, 1 + D> term;
          term[0] = flux(i, w, y, omega);
          for (int a = 0; a < D; ++a) term[1 + a] = term[0] * points.velocity[a][i];
          return term;
        });
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
