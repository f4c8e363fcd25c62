#include "core/geometry/voronoi.hpp"

#include <algorithm>
#include <cmath>
#include <voro++/voro++.hh>

#include "core/base/small_vector.hpp"
#include "core/geometry/cell_faces.hpp"

namespace perifrac {

namespace {

/// Calls use(i, cell) for every point and its cell, of lengths in spacings: Voro++'s tolerances are
/// absolute. A plane body is a slab one spacing thick with all points halfway up: its cells are
/// prisms.
template <class Cell, int D, class Use>
void for_each_cell(const Points<D>& points, const Vector<D>& low, const Vector<D>& high,
                   double spacing, Use&& use) {
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
  voro::c_loop_all at(box);
  Cell cell;
  if (!at.start()) return;
  do {
    if (box.compute_cell(cell, at)) use(static_cast<Index>(at.pid()), cell);
  } while (at.inc());
}

}  // namespace

template <int D>
void set_voronoi_volumes(Points<D>& points, const Vector<D>& low, const Vector<D>& high,
                         double spacing) {
  points.volume.assign(points.volume.size(), 0.0);
  const double unit = std::pow(spacing, D);
  for_each_cell<voro::voronoicell, D>(
      points, low, high, spacing,
      [&](Index i, voro::voronoicell& cell) { points.volume[i] = unit * cell.volume(); });
}

template <int D>
CellFaces<D> voronoi_cell_faces(const Points<D>& points, std::span<const Face> faces,
                                double spacing) {
  // Of cells that meet in an edge alone, as those of a lattice do: what rounding leaves.
  constexpr double negligible = 1e-10;
  Vector<D> low, high;
  for (int a = 0; a < D; ++a) {
    low[a] = faces[2 * a].coordinate;
    high[a] = faces[2 * a + 1].coordinate;
  }
  const double unit = std::pow(spacing, D - 1);
  CellFaces<D> found;
  std::vector<int> beyond;
  std::vector<double> areas;
  for_each_cell<voro::voronoicell_neighbor, D>(
      points, low, high, spacing, [&](Index i, voro::voronoicell_neighbor& cell) {
        cell.neighbors(beyond);
        cell.face_areas(areas);
        for (std::size_t k = 0; k < beyond.size(); ++k) {
          const int face = -1 - beyond[k];  // of the slab too, where they are no faces of the body
          if (areas[k] < negligible || face >= 2 * D || (face < 0 && beyond[k] < i)) continue;
          const double area = unit * areas[k];
          if (face < 0) {
            const double distance = norm(points.at(beyond[k]) - points.at(i));
            found.inner.push_back({i, beyond[k], area, distance});
          } else {
            const Face& at = faces[face];
            const double depth = at.direction * (at.coordinate - points.position[at.axis][i]);
            found.outer.push_back({i, face, area, depth});
          }
        }
      });
  std::ranges::sort(found.inner, {}, [](const auto& wall) { return std::pair(wall.i, wall.j); });
  std::ranges::sort(found.outer, {}, [](const auto& wall) { return std::pair(wall.i, wall.face); });
  return found;
}

template void set_voronoi_volumes<2>(Points<2>&, const Vector<2>&, const Vector<2>&, double);
template void set_voronoi_volumes<3>(Points<3>&, const Vector<3>&, const Vector<3>&, double);
template CellFaces<2> voronoi_cell_faces(const Points<2>&, std::span<const Face>, double);
template CellFaces<3> voronoi_cell_faces(const Points<3>&, std::span<const Face>, double);

}  // namespace perifrac
