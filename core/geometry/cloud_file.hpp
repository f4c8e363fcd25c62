#pragma once

#include <string>
#include <vector>

#include "core/base/points.hpp"

namespace perifrac {

/// Points as a file gives them.
template <int D>
struct CloudFile {
  Points<D> points;  ///< volume 0 where the file has none
  bool has_volumes = false;
  std::vector<int> line;  ///< where in the file a point stands
};

/// Reads points from `path`, lengths in [m]. A name that ends in `.vtk`: legacy VTK, ASCII, its
/// POINTS (z is dropped in 2D). Otherwise text with commas: a first line `x,y[,z][,volume]`, then a
/// line a point. Throws InputError `file:line: problem; expected ...`.
template <int D>
CloudFile<D> read_cloud(const std::string& path);

}  // namespace perifrac
