#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include "core/base/errors.hpp"
#include "core/config/scene.hpp"

namespace perifrac {

/// Keys of every sort: choices by `type`, conditions, names of the user's choice, lists, defaults.
inline const Catalogue& example_catalogue() {
  static const Catalogue catalogue = {
      {"",
       "",
       {{.path = "title", .type = KeyType::text, .meaning = "Name."},
        {.path = "dimension",
         .type = KeyType::integer,
         .range = "[2, 3]",
         .required = true,
         .meaning = "Of space."}}},
      {"body",
       "",
       {{.path = "shape",
         .type = KeyType::word,
         .fallback = "box",
         .words = {"box", "ball"},
         .meaning = "Shape."},
        {.path = "size",
         .type = KeyType::vector,
         .unit = "m",
         .range = "(0, inf)",
         .required = true,
         .when = "shape=box",
         .meaning = "Edges."},
        {.path = "radius",
         .unit = "m",
         .range = "(0, inf)",
         .required = true,
         .when = "shape=ball",
         .meaning = "Radius."},
        {.path = "spacing", .unit = "m", .range = "(0, inf)", .required = true, .meaning = "dx."}}},
      {"solid",
       "quasi_static",
       {{.path = "material.youngs_modulus",
         .unit = "Pa",
         .range = "(0, inf)",
         .required = true,
         .meaning = "Stiffness."},
        {.path = "material.poisson_ratio",
         .range = "(-1, 0.5)",
         .fallback = "0.25",
         .meaning = "Ratio."},
        {.path = "boundary.*.type",
         .type = KeyType::word,
         .required = true,
         .words = {"roller", "rigid_plate"},
         .meaning = "Condition."},
        {.path = "boundary.*.force",
         .unit = "N/m|N",
         .required = true,
         .when = "type=rigid_plate",
         .meaning = "Force."}},
       "Equilibrium at every moment."},
      {"solid", "rigid", {}, "Nothing moves."},
      {"pore_flow",
       "darcy",
       {{.path = "porosity", .range = "[0, 1)", .required = true, .meaning = "Pores."},
        {.path = "adaptive", .type = KeyType::boolean, .fallback = "true", .meaning = "Steps."},
        {.path = "iterations.max",
         .type = KeyType::integer,
         .range = "[1, inf)",
         .fallback = "3",
         .meaning = "Passes."},
        {.path = "boundary.*.type",
         .type = KeyType::word,
         .required = true,
         .words = {"pressure", "flux"},
         .meaning = "Condition."},
        {.path = "boundary.*.value",
         .unit = "Pa",
         .required = true,
         .when = "type=pressure",
         .meaning = "Pressure."},
        {.path = "boundary.*.value",
         .unit = "m/s",
         .required = true,
         .when = "type=flux",
         .meaning = "Flux."}}},
      {"output",
       "",
       {{.path = "times",
         .type = KeyType::numbers,
         .unit = "s",
         .range = "[0, inf)",
         .meaning = "."},
        {.path = "probes[].name", .type = KeyType::text, .required = true, .meaning = "Name."},
        {.path = "probes[].at",
         .type = KeyType::vector,
         .unit = "m",
         .required = true,
         .meaning = "Place."}}},
  };
  return catalogue;
}

/// A scene that holds, line by line as the tests count them.
inline const std::string example_scene = R"(title: Example
dimension: 2
body:
  size: [4 m, 2 m]
  spacing: 1 cm
solid:
  type: quasi_static
  material: {youngs_modulus: 1 GPa}
  boundary:
    top: {type: rigid_plate, force: 10 kN/m}
    left: {type: roller}
pore_flow:
  type: darcy
  porosity: 0.3
  boundary:
    right: {type: flux, value: 1 mm/s}
output:
  times: [1 s, 1 min]
  probes:
    - {name: centre, at: [0 m, 0 m]}
    - {name: edge, at: [40 cm, 0]}
)";

/// The file that a test's scene is written to; gone with the object.
class SceneFile {
 public:
  explicit SceneFile(const std::string& text)
      : path_(std::filesystem::temp_directory_path() /
              ("perifrac_scene_" + std::to_string(::getpid()) + ".yaml")) {
    std::ofstream(path_) << text;
  }
  SceneFile(const SceneFile&) = delete;
  SceneFile& operator=(const SceneFile&) = delete;
  ~SceneFile() { std::filesystem::remove(path_); }

  std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline Section read_text(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_scene(SceneFile(text).path(), overrides, example_catalogue());
}

/// The message that a scene gets, its file's name as `{file}`.
inline std::string refusal(const std::string& text,
                           const std::vector<std::string>& overrides = {}) {
  const SceneFile file(text);
  try {
    read_scene(file.path(), overrides, example_catalogue());
  } catch (const InputError& error) {
    std::string line = error.what();
    for (auto at = line.find(file.path()); at != std::string::npos; at = line.find(file.path())) {
      line.replace(at, file.path().size(), "{file}");
    }
    return line;
  }
  return "accepted";
}

/// The example with `from` replaced by `to`.
inline std::string changed(const std::string& from, const std::string& to) {
  std::string text = example_scene;
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace perifrac
