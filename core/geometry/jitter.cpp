#include "core/geometry/jitter.hpp"

#include "core/base/random_bits.hpp"
#include "core/base/small_vector.hpp"

namespace perifrac {

namespace {

template <int D, class Keep>
void jitter_where(Points<D>& points, double distance, std::uint64_t seed, Keep&& keep) {
  const std::uint64_t start = random_bits(seed, 0);  // so that the next seed is not one number on
  for (Index i = 0; i < points.size(); ++i) {
    Vector<D> x = points.at(i);
    for (int a = 0; a < D; ++a) {
      x[a] += distance * uniform(random_bits(start, std::uint64_t{D} * i + a));
    }
    if (!keep(x)) continue;
    set_at(points.position, i, x);
  }
}

}  // namespace

template <int D>
void jitter_points(Points<D>& points, double distance, std::uint64_t seed) {
  jitter_where(points, distance, seed, [](const Vector<D>&) { return true; });
}

template <int D>
void jitter_points_in_ball(Points<D>& points, double distance, std::uint64_t seed, double radius) {
  jitter_where(points, distance, seed, [&](const Vector<D>& x) {
    double r2 = 0.0;
    for (const double coordinate : x) r2 += coordinate * coordinate;
    return r2 < radius * radius;
  });
}

template void jitter_points<2>(Points<2>&, double, std::uint64_t);
template void jitter_points<3>(Points<3>&, double, std::uint64_t);
template void jitter_points_in_ball<2>(Points<2>&, double, std::uint64_t, double);
template void jitter_points_in_ball<3>(Points<3>&, double, std::uint64_t, double);

}  // namespace perifrac
