#pragma once

#include <array>
#include <pybind11/numpy.h>
#include <string>
#include <vector>

#include "core/base/point_set.hpp"

namespace perifrac {

/// Points of a module's own, which may move.
class PythonPoints {
 public:
  using Positions =
      pybind11::array_t<double, pybind11::array::c_style | pybind11::array::forcecast>;

  /// A row a point [m].
  PythonPoints(const std::string& name, const Positions& positions) {
    set_.name = name;
    move(positions);
    set_.version = 0;
  }

  /// Whoever has a mapping between them and other points makes it anew.
  void move(const Positions& positions) {
    if (positions.ndim() != 2 || positions.shape(1) < 2 || positions.shape(1) > 3) {
      throw pybind11::value_error("positions: expected an array of a row a point, 2 or 3 columns");
    }
    set_.dimension = static_cast<int>(positions.shape(1));
    set_.count = static_cast<std::size_t>(positions.shape(0));
    ++set_.version;
    const auto rows = positions.unchecked<2>();
    for (pybind11::ssize_t a = 0; a < rows.shape(1); ++a) {
      std::vector<double>& coordinate = coordinates_[static_cast<std::size_t>(a)];
      coordinate.resize(set_.count);
      for (pybind11::ssize_t i = 0; i < rows.shape(0); ++i) {
        coordinate[static_cast<std::size_t>(i)] = rows(i, a);
      }
      set_.position[static_cast<std::size_t>(a)] = coordinate;
    }
  }

  const PointSet& set() const { return set_; }

 private:
  PointSet set_;
  std::array<std::vector<double>, 3> coordinates_;
};

}  // namespace perifrac
