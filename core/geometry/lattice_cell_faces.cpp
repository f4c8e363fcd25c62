#include <algorithm>
#include <cmath>

#include "core/geometry/cell_faces.hpp"

namespace perifrac {

namespace {

/// The points of a lattice by the numbers of their cells along the axes.
template <int D>
class NumberedCells {
 public:
  using Cell = std::array<int, D>;

  NumberedCells(const Points<D>& points, double spacing) : points_(&points), spacing_(spacing) {
    std::size_t all = 1;
    for (int a = 0; a < D; ++a) {
      const auto [low, high] = std::ranges::minmax(points.position[a]);
      low_[a] = low;
      counts_[a] = static_cast<int>(std::lround((high - low) / spacing)) + 1;
      all *= counts_[a];
    }
    number_.assign(all, -1);
    for (Index i = 0; i < points.size(); ++i) number_[flat(cell_of(i))] = i;
  }

  /// The point next to i along an axis; -1 where there is none.
  Index beside(Index i, int axis, int direction) const {
    Cell cell = cell_of(i);
    cell[axis] += direction;
    const bool within = cell[axis] >= 0 && cell[axis] < counts_[axis];
    return within ? number_[flat(cell)] : -1;
  }

 private:
  Cell cell_of(Index i) const {
    Cell cell;
    for (int a = 0; a < D; ++a) {
      cell[a] = static_cast<int>(std::lround((points_->position[a][i] - low_[a]) / spacing_));
    }
    return cell;
  }

  std::size_t flat(const Cell& cell) const {
    std::size_t index = 0;
    for (int a = 0; a < D; ++a) index = index * counts_[a] + cell[a];
    return index;
  }

  const Points<D>* points_;
  double spacing_;
  Vector<D> low_;  ///< lowest coordinates of points [m]
  Cell counts_;
  std::vector<Index> number_;
};

}  // namespace

template <int D>
CellFaces<D> lattice_cell_faces(const Points<D>& points, std::span<const Face> faces,
                                double spacing) {
  const NumberedCells<D> cells(points, spacing);
  const double area = std::pow(spacing, D - 1);
  const auto depth = [&](const Face& face, Index i) {
    return face.direction * (face.coordinate - points.position[face.axis][i]);
  };
  CellFaces<D> found;
  for (Index i = 0; i < points.size(); ++i) {
    for (int a = 0; a < D; ++a) {
      for (const int direction : {-1, 1}) {
        const Index j = cells.beside(i, a, direction);
        if (j > i) found.inner.push_back({i, j, area, spacing});
      }
    }
    const bool behind = std::ranges::any_of(
        faces, [&](const Face& face) { return !face.curved() && depth(face, i) < 0.0; });
    for (int f = 0; f < std::ssize(faces) && !behind; ++f) {
      const Face& face = faces[f];
      if (face.curved() || cells.beside(i, face.axis, face.direction) >= 0) continue;
      if (depth(face, i) < 0.75 * spacing) found.outer.push_back({i, f, area, depth(face, i)});
    }
  }
  std::ranges::sort(found.inner, {}, [](const auto& wall) { return std::pair(wall.i, wall.j); });
  return found;
}

template CellFaces<2> lattice_cell_faces(const Points<2>&, std::span<const Face>, double);
template CellFaces<3> lattice_cell_faces(const Points<3>&, std::span<const Face>, double);

}  // namespace perifrac
