#include "modules/fluid/as_published/one_sided_wall_force.hpp"

#include <cmath>

#include "core/base/small_vector.hpp"
#include "modules/fluid/walls/wall_pairs.hpp"

namespace perifrac {

namespace {

double spline(double eta) {
  if (eta <= 2.0 / 3.0) return 2.0 / 3.0;
  if (eta <= 1.0) return (2.0 - 1.5 * eta) * eta;
  return eta < 2.0 ? 0.5 * (2.0 - eta) * (2.0 - eta) : 0.0;
}

}  // namespace

template <int D>
void OneSidedWallForce<D>::add(const FluidStep<D>& step, NearWalls<D>& walls,
                               FluidForces<D>& forces) {
  const FluidPoints<D>& points = step.points;
  const double spacing = step.scheme.spacing;
  const double strength = repulsion_ * step.fluid.sound_speed() * step.fluid.sound_speed();
  const WallDrag<D> drag(step, walls);
  add_pair_forces<D>(step, walls, forces, [&](Index i, Index w, const Vector<D>& y, double omega) {
    const double volumes = omega * points.volume[i] * walls.volume[w];
    WallPair<D> pair = drag.beside(stress_along<D>(step, i, y), i, w, y, volumes);
    const double square = squared_norm(y);
    const double r = std::sqrt(square);
    if (r >= spacing || step.cloud.depth[walls.wall[w]] > spacing) return pair;
    const double acceleration =
        strength * spline(r / (0.375 * step.scheme.horizon)) * (1.0 - r / spacing) / square;
    const double push = points.density[i] * points.volume[i] * acceleration;
    for (int a = 0; a < D; ++a) pair[a] -= push * y[a];
    return pair;
  });
}

template class OneSidedWallForce<2>;
template class OneSidedWallForce<3>;

}  // namespace perifrac
