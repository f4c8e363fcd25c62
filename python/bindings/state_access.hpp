#pragma once

#include <pybind11/numpy.h>
#include <string>
#include <vector>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// How a module of Python shows its state: `self.x = state.visit("x", self.x)`, arrays of numbers
/// or of whole numbers, and single ones. Of use only while visit_state runs.
class StateAccess {
 public:
  explicit StateAccess(StateVisitor& visitor) : visitor_(visitor) {}

  /// What stands there afterwards: the same array, where its size is.
  pybind11::object visit(const std::string& name, const pybind11::object& value) {
    namespace py = pybind11;
    if (py::isinstance<py::int_>(value)) return number<std::int64_t>(name, value);
    if (py::isinstance<py::float_>(value)) return number<double>(name, value);
    if (py::isinstance<py::array_t<double>>(value)) return array<double>(name, value);
    if (py::isinstance<py::array_t<std::int64_t>>(value)) return array<std::int64_t>(name, value);
    throw py::type_error("state " + name +
                         ": expected a float, an int, or an array of float64 or int64");
  }

 private:
  template <class Number>
  pybind11::object number(const std::string& name, const pybind11::object& value) {
    auto held = value.cast<Number>();
    visitor_.visit(name, held);
    return pybind11::cast(held);
  }

  template <class Number>
  pybind11::object array(const std::string& name, const pybind11::object& value) {
    using Array = pybind11::array_t<Number, pybind11::array::c_style | pybind11::array::forcecast>;
    const Array before(value);
    std::vector<Number> values(before.data(), before.data() + before.size());
    visitor_.visit(name, values);
    const Array after(static_cast<pybind11::ssize_t>(values.size()), values.data());
    if (after.size() != before.size()) return after;
    value[pybind11::ellipsis()] = after.attr("reshape")(value.attr("shape"));
    return value;
  }

  StateVisitor& visitor_;
};

}  // namespace perifrac
