#include "modules/fluid/walls/wall_contact.hpp"

#include "core/base/small_vector.hpp"

namespace perifrac {

template <int D>
double stop_at_walls(const FluidStep<D>& step, double length, FluidPoints<D>& points,
                     NearWalls<D>& walls) {
  const double rate = 0.5 * step.fluid.sound_speed() / step.scheme.spacing;
  const PeriodicImages<D>& images = step.neighbours.wall_images();
  double heat = 0.0;
  for (Index i = 0; i < points.count; ++i) {
    for_walls_below(step, walls, i, [&](Index w, const Vector<D>& normal, double height) {
      const double approach =
          -dot(normal, vector_at(points.velocity, i) - vector_at(walls.velocity, w));
      const double too_fast = approach - rate * height;
      if (too_fast <= 0.0) return;
      const Index source = w < walls.count ? w : images.source[w - walls.count];
      add_at(points.velocity, i, too_fast * normal);
      add_at(walls.force, source, -points.mass[i] * too_fast * normal / length);
      heat += points.mass[i] * too_fast * (approach - 0.5 * too_fast);
    });
  }
  return heat;
}

template double stop_at_walls<2>(const FluidStep<2>&, double, FluidPoints<2>&, NearWalls<2>&);
template double stop_at_walls<3>(const FluidStep<3>&, double, FluidPoints<3>&, NearWalls<3>&);

}  // namespace perifrac
