#include "app/run/forecast.hpp"

#include <array>
#include <fstream>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "app/run/coarse_twin.hpp"
#include "app/run/scene_keys.hpp"
#include "core/config/scene.hpp"

namespace perifrac {
namespace {

/// A quarter of a round crack of 6 mm, into which so much is pumped that it grows in every window.
std::string round_crack(const char* spacing) {
  return std::string(R"(
dimension: 3
body:
  shape: box
  size: [20 mm, 20 mm, 24 mm]
  horizon_ratio: 2
  spacing: )") +
         spacing + R"(
cracks: [{name: notch, centre: [0 mm, 0 mm, 12 mm], normal: [0, 0, 1], radius: 6 mm}]
solid:
  type: quasi_static
  material: {youngs_modulus: 20 GPa, poisson_ratio: 0.25}
  confining_stress: [10 MPa, 10 MPa, 10 MPa]
  boundary: {left: {type: roller}, front: {type: roller}, bottom: {type: roller}}
damage: {type: energy_release, fracture_energy: 20 J/m^2}
crack_fluid:
  type: network
  density: 1000 kg/m^3
  viscosity: 1 cP
  bulk_modulus: 2.2 GPa
  inlets: [{name: well, at: [0 mm, 0 mm, 12 mm], volume_rate: 2e-5 m^3/s}]
time: {end: 4 ms}
coupling: {window: {first: 20 us, largest: 20 us}}
)";
}

class ForecastOfARoundCrack : public testing::Test {
 protected:
  Section scene(const char* spacing) {
    std::ofstream(file_) << round_crack(spacing);
    return read_scene(file_, {}, scene_catalogue());
  }

  std::string file_ = testing::TempDir() + "round_crack.yaml";
};

/// Whether or not it is known how far it grows: no window of the trial shows what others cost.
TEST_F(ForecastOfARoundCrack, WindowsInWhichItGrowsCost) {
  for (const std::optional<double> facets_at_end : {std::optional<double>(), std::optional(1.0)}) {
    const Section read = scene("2 mm");
    Simulation simulation = make_simulation(read);
    initialize(read, simulation);
    constexpr std::array outputs{4e-3};
    for (int window = 0; window < 8; ++window) simulation.manager->advance(outputs[0]);
    const Index before = facet_count(simulation);
    const Forecast told = forecast(simulation, outputs, 1e-9, 0.0, facets_at_end);
    ASSERT_GT(facet_count(simulation), before) << "the trial's window is not one of growth";
    EXPECT_GT(told.windows, 100);
    // As many windows as that which the trial took, less what a busy machine kept it waiting.
    EXPECT_GT(told.seconds, 2.0 * told.trial_seconds);
  }
}

TEST_F(ForecastOfARoundCrack, ACoarseTwinTellsItsArea) {
  const Section read = scene("0.5 mm");
  const auto area =
      crack_size_of_coarse_twin(file_, {"time.end=1 ns", "output.interval=1 ns"}, read, 100.0);
  ASSERT_TRUE(area);
  EXPECT_NEAR(*area, 28.3e-6, 6e-6);  // 9 pi mm^2, in squares
}

}  // namespace
}  // namespace perifrac
