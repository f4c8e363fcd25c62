#include "core/geometry/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

namespace perifrac {

template <int D>
void set_voronoi_volumes(Points<D>& points, const Vector<D>& low, const Vector<D>& high,
                         double spacing) {
  // Lengths in spacings: Voro++'s tolerances are absolute. A plane body is a slab one spacing
  // thick with all points halfway up: its cells are prisms.
  std::array<double, 3> size{1.0, 1.0, 1.0};
  std::array<int, 3> blocks{1, 1, 1};
  for (int a = 0; a < D; ++a) {
    size[a] = (high[a] - low[a]) / spacing;
    blocks[a] = std::max(1, static_cast<int>(size[a] / 2.0));
  }
  voro::container box(0.0, size[0], 0.0, size[1], 0.0, size[2], blocks[0], blocks[1], blocks[2],
                      false, false, false, 8);
  for (Index i = 0; i < points.size(); ++i) {
    std::array<double, 3> x{0.5, 0.5, 0.5};
    for (int a = 0; a < D; ++a) x[a] = (points.position[a][i] - low[a]) / spacing;
    box.put(i, x[0], x[1], x[2]);
  }
  points.volume.assign(points.volume.size(), 0.0);
  const double unit = std::pow(spacing, D);
  voro::c_loop_all at(box);
  voro::voronoicell cell;
  if (!at.start()) return;
  do {
    if (box.compute_cell(cell, at)) points.volume[at.pid()] = unit * cell.volume();
  } while (at.inc());
}

template void set_voronoi_volumes<2>(Points<2>&, const Vector<2>&, const Vector<2>&, double);
template void set_voronoi_volumes<3>(Points<3>&, const Vector<3>&, const Vector<3>&, double);

}  // namespace perifrac
