#include "modules/fluid/walls/wall_contact.hpp"

namespace perifrac {

template <int D>
void stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                   NearWalls<D>& walls) {
  const double rate = 0.5 * step.fluid.sound_speed() / step.scheme.spacing;
  const PeriodicImages<D>& images = step.neighbours.wall_images();
  for (Index i = 0; i < points.count; ++i) {
    for_walls_below(step, walls, i, [&](Index w, const Vector<D>& normal, double height) {
      double approach = 0.0;
      for (int a = 0; a < D; ++a) {
        approach -= normal[a] * (points.velocity[a][i] - walls.velocity[a][w]);
      }
      const double too_fast = approach - rate * height;
      if (too_fast <= 0.0) return;
      const Index source = w < walls.count ? w : images.source[w - walls.count];
      for (int a = 0; a < D; ++a) {
        points.velocity[a][i] += too_fast * normal[a];
        walls.force[a][source] -= points.mass[i] * too_fast * normal[a] / length;
      }
    });
  }
}

template void stop_at_walls<2>(const FluidStep<2>&, double, FluidPoints<2>&, NearWalls<2>&);
template void stop_at_walls<3>(const FluidStep<3>&, double, FluidPoints<3>&, NearWalls<3>&);

}  // namespace perifrac
