#include "modules/fluid/wall_contact.hpp"

#include <algorithm>

namespace perifrac {

template <int D>
void stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                   NearWalls<D>& walls) {
  const double spacing = step.scheme.spacing;
  const double rate = 0.5 * step.fluid.sound_speed() / spacing;  // approach speed over height
  // A point in front of a wall has one of its points this near along the surface.
  const double aside = (D == 2 ? 0.51 : 0.72) * spacing;
  const Neighbours& near = step.neighbours.walls_of_fluid();
  const PeriodicImages<D>& images = step.neighbours.wall_images();
  for (Index i = 0; i < points.count; ++i) {
    for (Index k = near.offset[i]; k < near.offset[i + 1]; ++k) {
      const Index w = near.other[k];
      const Index wall = walls.wall[w];
      double square = 0.0, normal_distance = 0.0, approach = 0.0;
      for (int a = 0; a < D; ++a) {
        const double y = walls.position[a][w] - points.position[a][i];
        const double normal = step.cloud.normal[a][wall];
        square += y * y;
        normal_distance -= normal * y;
        approach -= normal * (points.velocity[a][i] - walls.velocity[a][w]);
      }
      if (square - normal_distance * normal_distance > aside * aside) continue;
      const double allowed = rate * std::max(0.0, normal_distance - step.cloud.depth[wall]);
      if (approach <= allowed) continue;
      const Index source = w < walls.count ? w : images.source[w - walls.count];
      for (int a = 0; a < D; ++a) {
        const double change = (approach - allowed) * step.cloud.normal[a][wall];
        points.velocity[a][i] += change;
        walls.force[a][source] -= points.mass[i] * change / length;
      }
    }
  }
}

template void stop_at_walls<2>(const FluidStep<2>&, double, FluidPoints<2>&, NearWalls<2>&);
template void stop_at_walls<3>(const FluidStep<3>&, double, FluidPoints<3>&, NearWalls<3>&);

}  // namespace perifrac
