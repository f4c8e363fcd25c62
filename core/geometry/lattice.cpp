#include "core/geometry/lattice.hpp"

#include <cmath>
#include <numbers>
#include <numeric>

#include "core/geometry/space_filling_curve.hpp"

namespace perifrac {

namespace {

template <int D, class Use>
void for_each_cell(const std::array<int, D>& counts, Use&& use) {
  std::array<int, D> cell{};
  const long total = std::accumulate(counts.begin(), counts.end(), 1L, std::multiplies<long>());
  for (long n = 0; n < total; ++n) {
    use(cell);
    for (int a = 0; a < D && ++cell[a] == counts[a]; ++a) cell[a] = 0;
  }
}

}  // namespace

template <int D>
Points<D> box_lattice(const std::array<int, D>& counts, double spacing,
                      const std::array<int, D>& first) {
  Points<D> points;
  const double volume = std::pow(spacing, D);
  for_each_cell<D>(counts, [&](const std::array<int, D>& cell) {
    Vector<D> x;
    for (int a = 0; a < D; ++a) x[a] = (first[a] + cell[a] + 0.5) * spacing;
    points.add(x, volume);
  });
  sort_along_curve(points, spacing);
  return points;
}

template <int D>
Points<D> ball_lattice(double radius, double spacing) {
  Points<D> points;
  const int half = static_cast<int>(std::ceil(radius / spacing));
  std::array<int, D> counts;
  counts.fill(2 * half);
  for_each_cell<D>(counts, [&](const std::array<int, D>& cell) {
    Vector<D> x;
    double r2 = 0.0;
    for (int a = 0; a < D; ++a) {
      x[a] = (cell[a] - half + 0.5) * spacing;
      r2 += x[a] * x[a];
    }
    if (r2 < radius * radius) points.add(x, 0.0);
  });
  const double ball = (D == 2 ? 1.0 : 4.0 / 3.0) * std::numbers::pi * std::pow(radius, D);
  points.volume.assign(points.volume.size(), ball / points.size());
  sort_along_curve(points, spacing);
  return points;
}

template Points<2> box_lattice<2>(const std::array<int, 2>&, double, const std::array<int, 2>&);
template Points<3> box_lattice<3>(const std::array<int, 3>&, double, const std::array<int, 3>&);
template Points<2> ball_lattice<2>(double, double);
template Points<3> ball_lattice<3>(double, double);

}  // namespace perifrac
