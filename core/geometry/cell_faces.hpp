#pragma once

#include <span>
#include <vector>

#include "core/base/points.hpp"
#include "core/geometry/faces.hpp"

namespace perifrac {

/// A body cut into cells, one a point: the walls between cells, each halfway between its two points
/// and across the line from one to the other, and those on the body's plane faces.
template <int D>
struct CellFaces {
  struct Inner {
    Index i;  ///< less than j
    Index j;
    double area;      ///< [m^2], in 2D, per metre, its length
    double distance;  ///< of the points [m]
  };
  struct Outer {
    Index i;
    int face;         ///< its number in the body's list
    double area;      ///< as above
    double distance;  ///< of the point from the face [m]
  };
  std::vector<Inner> inner;  ///< by i, then j
  std::vector<Outer> outer;  ///< by i, then face
};

/// Squares, or cubes, about the points of a lattice. Where a neighbour is missing and no plane face
/// passes half a spacing off, as at a cut-out, there is no wall. Points behind a face have none on
/// the others.
template <int D>
CellFaces<D> lattice_cell_faces(const Points<D>& points, std::span<const Face> faces,
                                double spacing);

/// Voronoi cells of points within a box, whose faces are given; `spacing` as set_voronoi_volumes().
template <int D>
CellFaces<D> voronoi_cell_faces(const Points<D>& points, std::span<const Face> faces,
                                double spacing);

}  // namespace perifrac
