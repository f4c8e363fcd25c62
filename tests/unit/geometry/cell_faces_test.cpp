#include "core/geometry/cell_faces.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/small_vector.hpp"
#include "core/geometry/voronoi.hpp"
#include "tests/unit/operators/test_bodies.hpp"

namespace perifrac {
namespace {

using test::Cloud;

template <int D>
CellFaces<D> walls_of(const Body<D>& body, Cloud cloud) {
  return cloud == Cloud::lattice ? lattice_cell_faces(body.points(), body.faces(), body.spacing())
                                 : voronoi_cell_faces(body.points(), body.faces(), body.spacing());
}

/// What the walls of a cell say of it: the sum of A n, which is nothing where they close, and the
/// volume of the pyramids from its point to them.
template <int D>
struct Cells {
  std::vector<Vector<D>> open;
  std::vector<double> volume;

  Cells(const Body<D>& body, const CellFaces<D>& walls)
      : open(body.points().size()), volume(body.points().size()) {
    const Points<D>& points = body.points();
    for (const auto& [i, j, area, distance] : walls.inner) {
      EXPECT_LT(i, j);
      EXPECT_NEAR(distance, norm(points.at(j) - points.at(i)), 1e-12);
      const Vector<D> part = (area / distance) * (points.at(j) - points.at(i));
      open[i] = open[i] + part;
      open[j] = open[j] - part;
      volume[i] += area * distance / (2 * D);
      volume[j] += area * distance / (2 * D);
    }
    for (const auto& [i, face, area, distance] : walls.outer) {
      const Face& at = body.faces()[face];
      EXPECT_NEAR(distance, at.direction * (at.coordinate - points.position[at.axis][i]), 1e-12);
      open[i][at.axis] += at.direction * area;
      volume[i] += area * distance / D;
    }
  }
};

template <int D>
void expect_closed_cells(Cloud cloud) {
  const auto body = test::box_body<D>(test::cube<D>(D == 2 ? 12 : 6), 0.5, cloud);
  const CellFaces<D> walls = walls_of(*body, cloud);
  const Cells<D> cells(*body, walls);
  Points<D> points = body->points();
  Vector<D> low{}, high;
  high.fill(D == 2 ? 6.0 : 3.0);
  set_voronoi_volumes<D>(points, low, high, 0.5);
  for (Index i = 0; i < points.size(); ++i) {
    EXPECT_LT(norm(cells.open[i]), 1e-12) << i;
    EXPECT_NEAR(cells.volume[i] / points.volume[i], 1.0, 1e-11) << i;
  }
  for (int f = 0; f < 2 * D; ++f) {
    double area = 0.0;
    for (const auto& wall : walls.outer) area += wall.face == f ? wall.area : 0.0;
    EXPECT_NEAR(area / body->area(f), 1.0, 1e-12) << body->faces()[f].name;
  }
}

TEST(CellFaces, CloseEveryCellAndFillTheBox) {
  for (const Cloud cloud : {Cloud::lattice, Cloud::jittered}) {
    expect_closed_cells<2>(cloud);
    expect_closed_cells<3>(cloud);
  }
}

template <int D>
void expect_squares_as_voronoi_cells() {
  const auto body = test::box_body<D>(test::cube<D>(5), 0.25);
  const CellFaces<D> squares = walls_of(*body, Cloud::lattice);
  const CellFaces<D> cells = voronoi_cell_faces(body->points(), body->faces(), body->spacing());
  ASSERT_EQ(squares.inner.size(), cells.inner.size());
  ASSERT_EQ(squares.outer.size(), cells.outer.size());
  for (std::size_t k = 0; k < cells.inner.size(); ++k) {
    EXPECT_EQ(squares.inner[k].i, cells.inner[k].i);
    EXPECT_EQ(squares.inner[k].j, cells.inner[k].j);
    EXPECT_NEAR(squares.inner[k].area / cells.inner[k].area, 1.0, 1e-12);
  }
  for (std::size_t k = 0; k < cells.outer.size(); ++k) {
    EXPECT_EQ(squares.outer[k].face, cells.outer[k].face);
    EXPECT_NEAR(squares.outer[k].area / cells.outer[k].area, 1.0, 1e-12);
  }
}

TEST(CellFaces, AreThoseOfVoronoiCellsOnALattice) {
  expect_squares_as_voronoi_cells<2>();
  expect_squares_as_voronoi_cells<3>();
}

TEST(CellFaces, AreNoneBesideACutoutNorBehindAFace) {
  // Rows of a layer lie behind the top; a hole of 2 x 2 cells inside, one at the left face.
  const auto layered = test::layered_body<2>({8, 6}, 1.0, 0b1000);
  Points<2> points;
  const auto hole = [](const Vector<2>& x) {
    const bool inside = x[0] > 3.0 && x[0] < 5.0 && x[1] > 2.0 && x[1] < 4.0;
    return inside || (x[0] < 1.0 && x[1] > 1.0 && x[1] < 2.0);
  };
  for (Index i = 0; i < layered->points().size(); ++i) {
    if (!hole(layered->points().at(i))) points.add(layered->points().at(i), 1.0);
  }
  const CellFaces<2> walls = lattice_cell_faces<2>(points, layered->faces(), 1.0);
  std::array<double, 4> area{};
  for (const auto& wall : walls.outer) area[wall.face] += wall.area;
  EXPECT_EQ(area, (std::array{5.0, 6.0, 8.0, 0.0}));
  // 9 rows of 8 with the layer's three: 63 walls across, 64 along; 4 + 8 are of the hole, 1 + 2 of
  // the notch.
  EXPECT_EQ(walls.inner.size(), 63u + 64u - 12u - 3u);
}

}  // namespace
}  // namespace perifrac
