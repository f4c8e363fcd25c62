#include "modules/fluid/particle_shifting.hpp"

#include <algorithm>

#include "core/base/small_vector.hpp"
#include "core/bonds/bond_traversal.hpp"
#include "modules/fluid/walls/wall_contact.hpp"

namespace perifrac {

namespace {

// Part of a lattice's shape tensor: of a flat surface .64, of the row below it .95.
constexpr double surface = 0.8;
constexpr double inside = 0.95;
constexpr double longest = 0.1;  // of a spacing
/// Points of a fluid at rest shift as if it moved at this part of its speed of sound: a lattice
/// under pressure is not stable by itself.
constexpr double least_speed = 0.01;

}  // namespace

template <int D>
void shift_points(const FluidStep<D>& step, const NearWalls<D>& walls, double strength,
                  double length, FluidPoints<D>& points) {
  const FluidMoments<D>& moments = step.moments;
  const double spacing = step.scheme.spacing;
  const double least = least_speed * step.fluid.sound_speed();
  for_each_point(points.count, [&](Index i) {
    const double part = moments.trace[i] / moments.bulk_trace;
    if (part <= surface) return;
    const double speed = norm(vector_at(points.velocity, i));
    const Vector<D> crowded = vector_at(moments.crowding, i);
    const double crowding = norm(crowded);
    if (crowding == 0.0) return;
    const double inwards = std::min(1.0, (part - surface) / (inside - surface));
    const double way =
        std::min(strength * length * std::max(least, speed) * inwards * spacing * crowding,
                 longest * spacing);
    Vector<D> shift = -way * crowded / crowding;
    for_walls_below(step, walls, i, [&](Index, const Vector<D>& normal, double height) {
      const double too_far = std::max(0.0, -dot(normal, shift) - 0.5 * height);
      shift += too_far * normal;
    });
    add_at(points.position, i, shift);
  });
}

template void shift_points<2>(const FluidStep<2>&, const NearWalls<2>&, double, double,
                              FluidPoints<2>&);
template void shift_points<3>(const FluidStep<3>&, const NearWalls<3>&, double, double,
                              FluidPoints<3>&);

}  // namespace perifrac
