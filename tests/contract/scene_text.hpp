#pragma once

#include <fstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <gtest/gtest.h>

#include "app/run/scene_keys.hpp"
#include "app/simulation/register_modules.hpp"
#include "core/config/scene.hpp"

namespace perifrac {

/// Reads a scene that stands in a test.
inline Section read_scene_text(const std::string& text,
                               const std::vector<std::string>& overrides = {},
                               const Catalogue& catalogue = scene_catalogue()) {
  const std::string path = testing::TempDir() + "scene_" + std::to_string(getpid()) + ".yaml";
  std::ofstream(path) << text;
  return read_scene(path, overrides, catalogue);
}

/// What the scene's section of that name stands for; null where no type has that name.
inline std::unique_ptr<PhysicsModule> make_module(const Section& scene, const std::string& physics,
                                                  const AnyBody& body) {
  const Section section = scene.at(physics);
  for (const ModuleType& type : module_types()) {
    if (type.section == physics && type.name == section.word("type")) {
      return type.make(section, body);
    }
  }
  return nullptr;
}

/// Sections of small scenes, to be put together.
inline const std::string box_2d = R"(
dimension: 2
body: {shape: box, size: [12 m, 11 m], spacing: 1 m}
time: {end: 1 s}
)";
inline const std::string box_3d = R"(
dimension: 3
body: {shape: box, size: [8 m, 5 m, 5 m], spacing: 1 m}
time: {end: 1 s}
)";
inline const std::string quasi_static_2d = R"(
solid:
  type: quasi_static
  material: {bulk_modulus: 1 GPa, shear_modulus: 0.4 GPa}
  boundary:
    left: {type: roller}
    bottom: {type: roller, normal_displacement: -1 mm}
    top: {type: rigid_plate, force: 1 MN/m}
    right: {type: traction, traction: [-1 MPa, 0.2 MPa]}
  body_force: [0 N/m^3, -10 kN/m^3]
)";
inline const std::string quasi_static_3d = R"(
solid:
  type: quasi_static
  material: {youngs_modulus: 1 GPa, poisson_ratio: 0.2}
  boundary:
    left: {type: fixed}
    top: {type: rigid_plate, force: 1 MN}
)";
/// quasi_static_2d with one word, and one key, changed.
inline const std::string dynamic_2d = [] {
  std::string text = quasi_static_2d;
  const std::string word = "quasi_static\n";
  return text.replace(text.find(word), word.size(),
                      "dynamic\n  density: 2000 kg/m^3\n  damping: 5 1/s\n");
}();
inline const std::string dynamic_3d = [] {
  std::string text = quasi_static_3d;
  const std::string word = "quasi_static\n";
  return text.replace(text.find(word), word.size(), "dynamic\n  density: 2000 kg/m^3\n");
}();
inline const std::string rigid = R"(
solid: {type: rigid}
)";
inline const std::string darcy = R"(
pore_flow:
  type: darcy
  permeability: 1 D
  porosity: 0.2
  grain_bulk_modulus: 20 GPa
  biot_coefficient: 0.9
  fluid: {bulk_modulus: 2 GPa, viscosity: 1 cP}
  initial_pressure: 0.1 MPa
  boundary:
    right: {type: pressure, pressure: 1 MPa}
    left: {type: flux, flux: 1 mm/s}
)";

/// The same pore flow with one word changed.
inline const std::string finite_volume = [] {
  std::string text = darcy;
  return text.replace(text.find("type: darcy"), 11, "type: finite_volume");
}();

/// Fluid for cracks that a test makes in box_2d.
inline const std::string crack_network = R"(
crack_fluid:
  type: network
  viscosity: 1 cP
  bulk_modulus: 2.2 GPa
  inlets:
    - {name: pump, at: [3 m, 5 m], rate: 5e-5 m^2/s}
)";

/// crack_network with one word changed: a key that the other has no use for may stay.
inline const std::string uniform_pressure = [] {
  std::string text = crack_network;
  const std::string word = "network";
  return text.replace(text.find(word), word.size(), "uniform_pressure");
}();
/// The word at the first `type:` of such a section.
inline std::string word_of_type(const std::string& section) {
  const auto begin = section.find("type: ") + 6;
  return section.substr(begin, section.find_first_of("\n,}", begin) - begin);
}

/// Free fluid in an open tank, with no body; what else it has comes by overrides.
inline const std::string tank_2d = R"(
dimension: 2
gravity: [0 m/s^2, -9.81 m/s^2]
time: {end: 1 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 0.1 MPa
  viscosity: 1 Pa s
  container: {from: [0 m, 0 m], to: [1.2 m, 0.8 m], faces: {top: open}}
  blocks:
    - {name: water, from: [0 m, 0 m], to: [0.7 m, 0.6 m], hydrostatic: true, velocity: [0.3 m/s, 0.1 m/s]}
)";
inline const std::string tank_3d = R"(
dimension: 3
gravity: [0 m/s^2, 0 m/s^2, -9.81 m/s^2]
time: {end: 1 s}
fluid:
  type: semi_lagrangian
  spacing: 0.1 m
  bulk_modulus: 0.1 MPa
  viscosity: 1 Pa s
  container: {from: [0 m, 0 m, 0 m], to: [0.8 m, 0.4 m, 0.5 m], faces: {top: open}}
  blocks:
    - {name: water, from: [0 m, 0 m, 0 m], to: [0.5 m, 0.4 m, 0.4 m], hydrostatic: true, velocity: [0.3 m/s, 0 m/s, 0.1 m/s]}
)";
/// Fluid over the top of box_2d and box_3d.
inline const std::string water_over_box_2d = R"(
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 0.1 MPa
  viscosity: 1 Pa s
  blocks:
    - {name: water, from: [2 m, 11 m], to: [9 m, 14 m], pressure: 2 kPa, velocity: [0.2 m/s, -0.3 m/s]}
)";
inline const std::string water_over_box_3d = R"(
interface: {}
fluid:
  type: semi_lagrangian
  bulk_modulus: 0.1 MPa
  viscosity: 1 Pa s
  blocks:
    - {name: water, from: [1 m, 1 m, 5 m], to: [6 m, 4 m, 8 m], pressure: 2 kPa, velocity: [0.2 m/s, 0 m/s, -0.3 m/s]}
)";

}  // namespace perifrac
