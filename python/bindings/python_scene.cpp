#include "python/bindings/python_scene.hpp"

#include <algorithm>
#include <pybind11/stl.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/installation/examples.hpp"
#include "app/run/scene_keys.hpp"
#include "core/base/errors.hpp"
#include "core/config/key_tree.hpp"
#include "core/config/override.hpp"
#include "core/config/scene.hpp"
#include "core/io/input_file.hpp"

namespace perifrac {

namespace py = pybind11;

namespace {

constexpr const char* without_file = "scene";

YamlNode to_yaml(const py::handle& value, const std::string& place);

void add_child(YamlNode& parent, YamlNode child, std::string key = {}) {
  child.key = std::move(key);
  parent.children.push_back(std::move(child));
}

/// `place` is what messages about it begin with.
YamlNode to_yaml(const py::handle& value, const std::string& place) {
  YamlNode node{.kind = YamlNode::Kind::scalar, .place = place, .key_place = place};
  if (value.is_none()) {
    node.kind = YamlNode::Kind::null;
  } else if (py::isinstance<py::dict>(value)) {
    node.kind = YamlNode::Kind::map;
    for (const auto& [key, child] : py::reinterpret_borrow<py::dict>(value)) {
      add_child(node, to_yaml(child, place), py::str(key).cast<std::string>());
    }
  } else if (py::isinstance<py::bool_>(value)) {
    node.text = value.cast<bool>() ? "true" : "false";
  } else if (py::isinstance<py::str>(value) || py::isinstance<py::int_>(value)) {
    node.text = py::str(value).cast<std::string>();
  } else if (py::isinstance<py::float_>(value)) {
    node.text = py::repr(py::float_(py::reinterpret_borrow<py::object>(value))).cast<std::string>();
  } else if (py::hasattr(value, "tolist")) {  // of numpy
    return to_yaml(value.attr("tolist")(), place);
  } else if (py::isinstance<py::sequence>(value)) {
    node.kind = YamlNode::Kind::list;
    for (const py::handle& child : value) add_child(node, to_yaml(child, place));
  } else {
    throw InputError(
        fmt::format("{}: a {} has no place in a scene; expected text, a number, true, "
                    "false, None, a list or a dictionary",
                    place, py::type::of(value).attr("__name__").cast<std::string>()));
  }
  return node;
}

py::object to_python(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return py::none();
    case YamlNode::Kind::scalar: {
      if (node.text == "true" || node.text == "false") return py::bool_(node.text == "true");
      for (const auto type : {&PyLong_Type, &PyFloat_Type}) {
        const py::handle number(reinterpret_cast<PyObject*>(type));
        try {
          return number(node.text);
        } catch (py::error_already_set& error) {
          if (!error.matches(PyExc_ValueError)) throw;
        }
      }
      return py::str(node.text);
    }
    case YamlNode::Kind::list: {
      py::list list;
      for (const YamlNode& child : node.children) list.append(to_python(child));
      return list;
    }
    case YamlNode::Kind::map: {
      py::dict map;
      for (const YamlNode& child : node.children) map[py::str(child.key)] = to_python(child);
      return map;
    }
  }
  return py::none();
}

YamlNode* child_of(YamlNode& node, const std::string& segment) {
  for (std::size_t k = 0; k < node.children.size(); ++k) {
    const bool is_item = node.kind == YamlNode::Kind::list && segment == fmt::format("[{}]", k);
    if (is_item || (node.kind == YamlNode::Kind::map && node.children[k].key == segment)) {
      return &node.children[k];
    }
  }
  return nullptr;
}

YamlNode* find(YamlNode& tree, const std::string& path) {
  YamlNode* node = &tree;
  if (path.empty()) return node;
  for (const std::string& segment : path_segments(path)) {
    if (node != nullptr) node = child_of(*node, segment);
  }
  return node;
}

const YamlNode* find(const YamlNode& tree, const std::string& path) {
  return find(const_cast<YamlNode&>(tree), path);
}

/// All that is wrong with a scene that may not be whole yet: what is missing is left out.
std::vector<std::string> mistakes_of(const YamlNode& tree, const std::string& name) {
  std::vector<std::string> lines;
  try {
    check_tree(tree, name, scene_catalogue());
  } catch (const InputError& error) {
    const std::string_view text = error.what();
    for (std::size_t at = 0; at < text.size();) {
      const std::size_t end = std::min(text.find('\n', at), text.size());
      const std::string_view line = text.substr(at, end - at);
      if (line.find("missing key '") == std::string_view::npos) lines.emplace_back(line);
      at = end + 1;
    }
  }
  return lines;
}

/// Libraries find the core in the program, which is not here.
void refuse_libraries(const YamlNode& tree) {
  if (const YamlNode* const list = tree.child("modules")) {
    throw InputError(fmt::format(
        "{}: modules: libraries are loaded by the program alone; expected a class of Python "
        "(perifrac.add_module_type)",
        list->key_place));
  }
}

}  // namespace

PythonScene PythonScene::from_file(const std::string& path) {
  PythonScene scene(parse_yaml_file(path), path);
  refuse_libraries(scene.tree_);
  scene.file_text_ = read_input_text(path, "a scene file");
  scene.section();
  return scene;
}

PythonScene PythonScene::from_values(const py::dict& values) {
  PythonScene scene(to_yaml(values, without_file), without_file);
  refuse_libraries(scene.tree_);
  const auto mistakes = mistakes_of(scene.tree_, scene.name_);
  if (!mistakes.empty()) throw InputError(fmt::format("{}", fmt::join(mistakes, "\n")));
  return scene;
}

void PythonScene::set(const std::string& path, const py::object& value) {
  const std::string place = fmt::format("scene[\"{}\"]", path);
  YamlNode tree = tree_;
  YamlNode node = to_yaml(value, place);
  const std::string assignment = path + "=" + yaml_text(node);
  set_key(tree, path, std::move(node));
  refuse_libraries(tree);
  const auto before = mistakes_of(tree_, name_);
  std::vector<std::string> wrong;
  for (std::string& line : mistakes_of(tree, name_)) {
    if (std::ranges::find(before, line) == before.end()) wrong.push_back(std::move(line));
  }
  if (!wrong.empty()) throw InputError(fmt::format("{}", fmt::join(wrong, "\n")));
  tree_ = std::move(tree);
  assignments_.push_back(assignment);
}

py::object PythonScene::get(const std::string& path) const {
  const YamlNode* const node = find(tree_, path);
  if (node == nullptr) throw py::key_error(path + " is not written in the scene");
  return to_python(*node);
}

bool PythonScene::has(const std::string& path) const { return find(tree_, path) != nullptr; }

void PythonScene::remove(const std::string& path) {
  const YamlNode* const node = find(tree_, path);
  if (node == nullptr) throw py::key_error(path + " is not written in the scene");
  const auto last = path.find_last_of(".[");
  YamlNode* const parent = find(tree_, last == std::string::npos ? "" : path.substr(0, last));
  parent->children.erase(parent->children.begin() + (node - parent->children.data()));
  file_text_.clear();  // no --set takes a key away
}

Section PythonScene::section() const {
  return check_tree(tree_, name_ == without_file ? "" : name_, scene_catalogue());
}

std::string PythonScene::text() const {
  if (file_text_.empty()) return yaml() + "\n";
  std::string text = file_text_;
  for (const std::string& assignment : assignments_) text += "# --set " + assignment + '\n';
  return text;
}

std::string PythonScene::yaml() const {
  if (tree_.kind != YamlNode::Kind::map) return "{}";
  std::string text;
  for (const YamlNode& child : tree_.children) {
    if (!text.empty()) text += '\n';
    text += child.key + ": " + yaml_text(child);
  }
  return text;
}

void bind_scene(py::module_& module) {
  py::class_<Section>(module, "Section",
                      "What a part of a scene says once checked: SI, defaults filled in. Paths are "
                      "relative to it.")
      .def("has", &Section::has, py::arg("path"), "It is written, or has a default.")
      .def("number", &Section::number, py::arg("path"), "A quantity, in SI.")
      .def("integer", &Section::integer, py::arg("path"), "A whole number.")
      .def("boolean", &Section::boolean, py::arg("path"), "True or False.")
      .def("word", &Section::word, py::arg("path"), "One of the words that the key takes.")
      .def("text", &Section::text, py::arg("path"), "Free text.")
      .def("file", &Section::file, py::arg("path"),
           "A text that names a file, seen from the scene's folder.")
      .def("numbers", &Section::numbers, py::arg("path"), "A vector or list of quantities, in SI.")
      .def("names", &Section::names, py::arg("path") = "", "Keys that are written there.")
      .def("count", &Section::count, py::arg("path"), "Items of a list; 0 where there is none.")
      .def("at", &Section::at, py::arg("path"), "A part of it.")
      .def("scene", &Section::scene, "The whole scene.")
      .def("fail", &Section::fail, py::arg("path"), py::arg("problem"), py::arg("expected"),
           "Raises SceneError, placed where the key stands.");
  py::class_<PythonScene>(module, "Scene",
                          "A scene as an object: scene[\"crack_fluid.inlets[0].rate\"] = \"2e-4 "
                          "m^2/s\". Quantities are "
                          "texts with their units, or numbers in SI. The program's catalogue "
                          "checks each key that is set: "
                          "what is wrong raises SceneError with the line of the program, and "
                          "leaves the scene as it is.")
      .def(py::init(&PythonScene::from_values), py::arg("values") = py::dict())
      .def_static("from_file", &PythonScene::from_file, py::arg("path"), "Reads and checks a file.")
      .def_static(
          "example",
          [](const std::string& name) { return PythonScene::from_file(example_scene(name)); },
          py::arg("name"), "A scene that comes with the program, as `mandel`.")
      .def("__setitem__", &PythonScene::set)
      .def("__getitem__", &PythonScene::get)
      .def("__delitem__", &PythonScene::remove)
      .def("__contains__", &PythonScene::has)
      .def("section", &PythonScene::section,
           "Checks it whole, and gives what the program reads: SI.")
      .def("__copy__", [](const PythonScene& scene) { return scene; })
      .def(
          "copy", [](const PythonScene& scene) { return scene; }, "Another one with the same keys.")
      .def("yaml", &PythonScene::yaml, "As a file of the program.")
      .def_property_readonly("name", &PythonScene::name, "Its file; `scene` where there is none.")
      .def("__repr__", [](const PythonScene& scene) { return "<Scene " + scene.name() + ">"; });
}

}  // namespace perifrac
