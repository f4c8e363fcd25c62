#include <algorithm>
#include <map>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include "app/simulation/outside_modules.hpp"
#include "app/simulation/register_modules.hpp"
#include "core/base/errors.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/errors.hpp"
#include "python/bindings/port_words.hpp"
#include "python/bindings/python_module.hpp"
#include "python/bindings/python_points.hpp"
#include "python/bindings/state_access.hpp"

namespace perifrac {

namespace py = pybind11;

namespace {

/// What a module of Python may know of the body.
struct BodyView {
  AnyBody any;

  template <class Ask>
  auto ask(Ask&& what) const {
    return std::visit(
        [&](const auto& body) {
          if (!body) throw std::logic_error("the scene has no body");
          return what(*body);
        },
        any);
  }
};

void bind_body(py::module_& module) {
  py::class_<BodyView>(module, "Body", "The rock that modules share, which none of them changes.")
      .def_property_readonly(
          "dimension", [](const BodyView& view) { return view.any.index() + 2; }, "2 or 3.")
      .def_property_readonly(
          "spacing",
          [](const BodyView& view) {
            return view.ask([](const auto& body) { return body.spacing(); });
          },
          "Between points [m].")
      .def_property_readonly(
          "horizon",
          [](const BodyView& view) {
            return view.ask([](const auto& body) { return body.horizon(); });
          },
          "How far points act on each other [m].")
      .def_property_readonly(
          "positions",
          [](const BodyView& view) {
            return view.ask([](const auto& body) {
              const PointSet& set = body.point_set();
              return positions_of(std::span(set.position).first(set.dimension), set.count);
            });
          },
          "A row a point [m]; a copy.")
      .def_property_readonly(
          "volumes",
          [](const py::object& self) {
            return self.cast<const BodyView&>().ask(
                [&](const auto& body) { return view_of(body.points().volume, 1, self, false); });
          },
          "By point [m^3], in 2D [m^2]; a view.")
      .def_property_readonly(
          "faces",
          [](const BodyView& view) {
            return view.ask([](const auto& body) {
              py::dict faces;
              for (const Face& face : body.faces()) {
                faces[py::str(face.name)] =
                    py::make_tuple(face.axis, face.direction, face.coordinate);
              }
              return faces;
            });
          },
          "By name: axis, direction of the outward normal along it, coordinate [m].");
}

/// Of Python, by `section.name`. Never taken away: types last as long as the process.
std::map<std::string, py::handle>& classes() {
  static std::map<std::string, py::handle> all;
  return all;
}

std::unique_ptr<PhysicsModule> make(const std::string& name, const Section& section,
                                    const AnyBody& body) {
  const py::gil_scoped_acquire gil;
  const py::handle type = classes().at(name);
  const auto type_name = py::str(type.attr("__name__")).cast<std::string>();
  try {
    return std::make_unique<PythonModule>(type(section, BodyView{body}), body,
                                          name.substr(0, name.find('.')));
  } catch (py::error_already_set& error) {
    rethrow(error, type_name + "()");
  }
}

void add_python_type(const std::string& section, const std::string& name, const py::object& type) {
  const std::string full = section + "." + name;
  const bool is_again = classes().contains(full);
  const bool is_taken = std::ranges::any_of(module_types(), [&](const ModuleType& known) {
    return known.section == section && known.name == name;
  });
  if (is_taken && !is_again) {
    throw InputError(
        fmt::format("add_module_type: there is a '{}: {{type: {}}}' already; expected another name",
                    section, name));
  }
  py::handle& held = classes()[full];
  held = py::object(type).release();
  if (is_again) return;  // a cell of a notebook that ran once more
  add_module_type(
      {.section = section,
       .name = name,
       .meaning = type.attr("meaning").cast<std::string>(),
       .keys = type.attr("keys").cast<KeyTable>(),
       .make = [full](const Section& part, const AnyBody& body) { return make(full, part, body); },
       .needs_body = type.attr("needs_body").cast<bool>()});
}

void bind_ports(py::module_& module) {
  py::class_<Port>(
      module, "Port",
      "The fixed part of a port. direction: in or out. kind: intensive, a value at a point, or "
      "extensive, a total over the window. role: field, property (for links alone), mass_stored, "
      "mass_gained [kg], energy_stored, energy_gained, energy_dissipated [J], ... Two values that "
      "differ by less than `negligible` agree.")
      .def(py::init([](std::string name, std::string unit, const std::string& direction,
                       const std::string& kind, const std::string& role, int components,
                       double negligible) {
             return Port{.name = std::move(name),
                         .unit = std::move(unit),
                         .direction = value_of(directions, direction),
                         .kind = value_of(kinds, kind),
                         .role = value_of(roles, role),
                         .components = components,
                         .negligible = negligible};
           }),
           py::arg("name"), py::arg("unit"), py::arg("direction") = "out",
           py::arg("kind") = "intensive", py::arg("role") = "field", py::arg("components") = 1,
           py::arg("negligible") = 0.0)
      .def_readonly("name", &Port::name, "Links are made between ports of one name.")
      .def_readonly("unit", &Port::unit, "SI.")
      .def_readonly("components", &Port::components, "Values a point.")
      .def_readonly("negligible", &Port::negligible, "A value as good as none, in its unit.")
      .def_property_readonly(
          "direction", [](const Port& port) { return word_of(directions, port.direction); },
          "in or out.")
      .def_property_readonly(
          "kind", [](const Port& port) { return word_of(kinds, port.kind); },
          "intensive or extensive.")
      .def_property_readonly(
          "role", [](const Port& port) { return word_of(roles, port.role); },
          "field, property, mass_stored, ...");
  py::class_<PythonPoints>(module, "PointSet", "Points of a module's own: a row a point [m].")
      .def(py::init<const std::string&, const PythonPoints::Positions&>(), py::arg("name"),
           py::arg("positions"))
      .def("move", &PythonPoints::move, py::arg("positions"),
           "They move, come or go [m]: mappings to other points are made anew.");
  py::class_<StateAccess>(module, "State", "How a module shows what evolves.")
      .def("visit", &StateAccess::visit, py::arg("name"), py::arg("value"),
           "Returns what the field is from now on: self.x = state.visit(\"x\", self.x).");
}

void bind_keys(py::module_& module) {
  py::class_<Key>(
      module, "Key",
      "A key that a module reads of its section, relative to it. `unit` is SI, `range` as in "
      "(0, inf), `default` as it would stand in a scene.")
      .def(py::init([](std::string path, const std::string& type, std::string unit,
                       std::string range, std::string fallback, bool required,
                       std::vector<std::string> words, std::string when, std::string meaning) {
             return Key{.path = std::move(path),
                        .type = value_of(key_types, type),
                        .unit = std::move(unit),
                        .range = std::move(range),
                        .fallback = std::move(fallback),
                        .required = required,
                        .words = std::move(words),
                        .when = std::move(when),
                        .meaning = std::move(meaning)};
           }),
           py::arg("path"), py::arg("type") = "number", py::arg("unit") = "", py::arg("range") = "",
           py::arg("default") = "", py::arg("required") = false,
           py::arg("words") = std::vector<std::string>{}, py::arg("when") = "",
           py::arg("meaning") = "")
      .def_readonly("path", &Key::path, "Relative to the section.");
}

}  // namespace

void bind_modules(py::module_& module) {
  bind_ports(module);
  bind_body(module);
  bind_keys(module);
  module.def("add_module_type", add_python_type, py::arg("section"), py::arg("name"),
             py::arg("type"),
             "From now on `section: {type: name}` of a scene is this class, derived from Module.");
}

}  // namespace perifrac
