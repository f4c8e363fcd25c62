#pragma once

#include <pybind11/numpy.h>
#include <span>

namespace perifrac {

/// Values of a port as an array without a copy: one a point, or `(points, components)`. `owner`
/// lives as long as the array does; the values may move when the simulation goes on.
inline pybind11::array_t<double> view_of(std::span<const double> values, int components,
                                         pybind11::handle owner, bool writeable) {
  const auto size = static_cast<pybind11::ssize_t>(values.size());
  constexpr pybind11::ssize_t item = sizeof(double);
  std::vector<pybind11::ssize_t> shape = {size}, strides = {item};
  if (components > 1) {
    shape = {size / components, components};
    strides = {item, item * shape[0]};
  }
  pybind11::array_t<double> array(shape, strides, values.data(), owner);
  if (!writeable) array.attr("setflags")(pybind11::arg("write") = false);
  return array;
}

/// Positions, a row a point; a copy, for each coordinate lies apart.
inline pybind11::array_t<double> positions_of(std::span<const std::span<const double>> coordinates,
                                              std::size_t count) {
  pybind11::array_t<double> rows(std::vector<pybind11::ssize_t>{
      static_cast<pybind11::ssize_t>(count), static_cast<pybind11::ssize_t>(coordinates.size())});
  auto at = rows.mutable_unchecked<2>();
  for (std::size_t a = 0; a < coordinates.size(); ++a) {
    for (std::size_t i = 0; i < count; ++i) {
      at(static_cast<pybind11::ssize_t>(i), static_cast<pybind11::ssize_t>(a)) = coordinates[a][i];
    }
  }
  return rows;
}

}  // namespace perifrac
