#include <cmath>

#include <gtest/gtest.h>

#include "app/simulation/simulation.hpp"
#include "tests/contract/scene_text.hpp"

namespace perifrac {
namespace {

// A sealed column that is loaded at once at its top: the wave runs at the undrained speed, since no
// fluid moves while it passes.
const std::string column = R"(
dimension: 2
body: {shape: box, size: [3 m, 40 m], spacing: 0.5 m}
solid:
  type: dynamic
  density: 2000 kg/m^3
  material: {lame_lambda: 1 GPa, shear_modulus: 1 GPa}
  boundary:
    bottom: {type: roller}
    left: {type: roller}
    right: {type: roller}
    top: {type: traction, traction: [0 Pa, -100 kPa]}
pore_flow:
  type: darcy
  permeability: 1e-17 m^2
  porosity: 0.2
  grain_bulk_modulus: 20 GPa
  biot_coefficient: 0.9
  integrator: {type: explicit}
  fluid: {bulk_modulus: 2 GPa, viscosity: 1 cP}
time: {end: 1 s}
)";
const double storage = 0.2 / 2e9 + 0.7 / 20e9;
const double undrained_modulus = 3e9 + 0.81 / storage;
const double speed = std::sqrt(undrained_modulus / 2000.0);

struct Column {
  Simulation simulation;

  explicit Column(const std::vector<std::string>& overrides) {
    const Section scene = read_scene_text(column, overrides);
    simulation = make_simulation(scene);
    initialize(scene, simulation);
    simulation.manager->settle();
  }
  void run(double until) {
    while (simulation.manager->time() < until) simulation.manager->advance(until);
  }
  /// Settlement of the points under the top [m].
  double settlement() const {
    const auto& points = std::get<std::shared_ptr<const Body<2>>>(simulation.body)->points();
    const std::span<const double> u = field_named(*simulation.manager, "displacement").values();
    const auto top = std::ranges::max_element(points.position[1]) - points.position[1].begin();
    return -u[points.size() + top];
  }
};

class UndrainedColumn : public testing::TestWithParam<const char*> {};

TEST_P(UndrainedColumn, SwingsAtTheUndrainedSpeed) {
  Column run({GetParam(), "coupling.window.first=1 ms", "coupling.window.largest=1 ms"});
  // The settlement rises with load / (density c) until the wave is back after two crossings, then
  // falls as fast until four. Over that rate it is a length, known to the spacing of the lattice.
  const double rate = 1e5 / (2000.0 * speed);
  for (const auto& [travelled, expected] :
       {std::pair{20.0, 20.0}, {60.0, 60.0}, {100.0, 60.0}, {140.0, 20.0}}) {
    run.run(travelled / speed);
    EXPECT_NEAR(speed * run.settlement() / rate, expected, 0.6) << travelled;
  }
}

INSTANTIATE_TEST_SUITE_P(Windows, UndrainedColumn,
                         testing::Values("coupling.window.type=schedule",
                                         "coupling.window.type=one_step"),
                         [](const auto& info) { return std::to_string(info.index); });

/// Without damping, through windows of many steps and of one, with fluid that moves far in a
/// window: nothing feeds the vibrations.
TEST(UndrainedSplit, FeedsNoEnergyIntoVibrations) {
  const char* const windows[] = {"coupling.window.type=one_step", "coupling.window.largest=2 ms",
                                 "coupling.window.largest=20 ms"};
  const std::vector<std::string> flows[] = {
      {"pore_flow.integrator.type=explicit", "pore_flow.permeability=1e-11 m^2"},
      {"pore_flow.integrator.type=explicit", "pore_flow.permeability=1e-13 m^2"},
      {"pore_flow.integrator.type=cvode", "pore_flow.permeability=1e-11 m^2"}};
  for (const char* window : windows) {
    for (std::vector<std::string> overrides : flows) {
      overrides.push_back(window);
      Column run(overrides);
      run.run(0.2);
      EXPECT_LT(run.simulation.manager->ledger().energy()->relative_error, 1.3e-2)
          << window << ' ' << overrides[0] << ' ' << overrides[1];
    }
  }
}

}  // namespace
}  // namespace perifrac
