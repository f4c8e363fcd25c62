#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "app/simulation/simulation.hpp"
#include "tests/contract/scene_text.hpp"
#include "tests/port_named.hpp"

namespace perifrac::test {

using Overrides = std::vector<std::string>;

/// Pore flow alone in a box, run to the scene's end.
struct PoreRun {
  Simulation simulation;
  const Points<2>& points;
  std::span<const double> pressure;

  explicit PoreRun(const std::string& scene, const Overrides& overrides = {})
      : simulation(make_simulation(read_scene_text(scene, overrides))),
        points(std::get<std::shared_ptr<const Body<2>>>(simulation.body)->points()) {
    CouplingManager& manager = *simulation.manager;
    manager.initialize(0.0);
    manager.settle();
    while (manager.time() < simulation.end) manager.advance(simulation.end);
    pressure = field("pore_pressure");
  }

  std::span<const double> field(const std::string& name) const {
    return field_named(*simulation.manager, name).values();
  }
  double scalar(const std::string& name) const {
    return test::port_named(*simulation.manager->modules()[0].module, name).value[0];
  }
  double mass_error() const { return simulation.manager->ledger().mass()->relative_error; }
  double energy_error() const { return simulation.manager->ledger().energy()->relative_error; }

  /// Largest |p - exact(x)|.
  template <class Exact>
  double error(Exact&& exact) const {
    double worst = 0.0;
    for (Index i = 0; i < points.size(); ++i) {
      const double difference = std::abs(pressure[i] - exact(points.at(i)));
      if (!(difference <= worst)) worst = difference;
    }
    return worst;
  }
};

inline const Overrides explicit_steps = {"pore_flow.integrator.type=explicit"};

/// Steady flow through two layers in series: the flux is that of their resistances.
inline const std::string two_layers = R"(
dimension: 2
body:
  shape: box
  size: [20 m, 6 m]
  spacing: 1 m
  regions:
    far: {from: [10 m, -1 m]}
pore_flow:
  type: darcy
  permeability: 4e-12 m^2
  porosity: 0.2
  biot_coefficient: 0.9
  grain_bulk_modulus: 20 GPa
  fluid: {bulk_modulus: 2 GPa, viscosity: 1 cP}
  regions:
    far: {permeability: 1e-12 m^2, porosity: 0.1, biot_coefficient: 0.5}
  boundary:
    left: {type: pressure, pressure: 1 MPa}
    right: {type: pressure, pressure: 0 Pa}
  integrator: {tolerance: 1e-8}
time: {end: 1000 s}
)";

inline const std::string heavy_fluid = R"(
dimension: 2
gravity: [0 m/s^2, -9.81 m/s^2]
body:
  shape: box
  size: [12 m, 20 m]
  spacing: 1 m
  regions:
    clay: {from: [-1 m, 5 m], to: [13 m, 9 m]}
pore_flow:
  type: darcy
  permeability: 1e-11 m^2
  porosity: 0.2
  grain_bulk_modulus: 20 GPa
  fluid: {bulk_modulus: 22 MPa, viscosity: 1 cP}
  initial_state: hydrostatic
  regions:
    clay: {permeability: 1e-13 m^2, porosity: 0.4}
  boundary:
    top: {type: pressure, pressure: 0 Pa}
time: {end: 100 s}
)";

inline const Overrides lateral = {
    "pore_flow.boundary.left={type: pressure, pressure: 0 Pa, hydrostatic: true}",
    "pore_flow.boundary.right={type: pressure, pressure: 0 Pa, hydrostatic: true}"};
inline const std::string tait = "pore_flow.fluid.equation_of_state=tait";

/// d(p)/d(depth) = rho(p) g, integrated by the Tait equation where the fluid is compressible.
inline double hydrostatic_pressure(const Vector<2>& x, bool compressible) {
  const double depth = 9810.0 * (20.0 - x[1]);
  if (!compressible) return depth;
  return 22e6 / 7.5 * (std::pow(1.0 + 6.5 * depth / 22e6, 7.5 / 6.5) - 1.0);
}

/// A layer, sealed at the left; the pressure of its right face rises to 1 MPa in 2 s and stays.
inline const std::string ramped_face = R"(
dimension: 2
body: {shape: box, size: [20 m, 5 m], spacing: 0.5 m}
pore_flow:
  type: darcy
  permeability: 1e-11 m^2
  porosity: 0.2
  fluid: {bulk_modulus: 2 GPa, viscosity: 1 cP}
  integrator: {tolerance: 1e-7}
  boundary:
    right: {type: pressure, pressure: 1 MPa, schedule: {ramp: 2 s}}
time: {end: 3 s}
)";

/// Duhamel's integral of the series for a step.
inline double ramped_pressure(double x, double t) {
  const double ramp = 2.0, c = 1e-8 / 1e-10, length = 20.0, risen = std::min(t, ramp);
  double p = risen;
  for (int n = 0; n < 200; ++n) {
    const double k = (n + 0.5) * std::numbers::pi / length, rate = c * k * k;
    const double part = (std::exp(-rate * (t - risen)) - std::exp(-rate * t)) / rate;
    p -= 2.0 / ((n + 0.5) * std::numbers::pi) * (n % 2 == 0 ? 1.0 : -1.0) * std::cos(k * x) * part;
  }
  return 1e6 * p / ramp;
}

/// Between two pressures the mass flux rho(p) dp/dx is the same everywhere.
inline const std::string soft_fluid = R"(
dimension: 2
body: {shape: box, size: [20 m, 6 m], spacing: 1 m}
pore_flow:
  type: darcy
  permeability: 1e-11 m^2
  porosity: 0.2
  biot_coefficient: 0.9
  grain_bulk_modulus: 20 GPa
  fluid: {bulk_modulus: 22 MPa, viscosity: 1 cP, equation_of_state: tait}
  initial_pressure: 1 MPa
  integrator: {tolerance: 1e-8}
  boundary:
    left: {type: pressure, pressure: 6 MPa}
    right: {type: pressure, pressure: 0 Pa}
time: {end: 10000 s}
)";

}  // namespace perifrac::test
