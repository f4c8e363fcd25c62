#include "tests/verification/mandel_run.hpp"

#include <algorithm>
#include <chrono>

#include <nlohmann/json.hpp>

#include "app/output_times.hpp"
#include "app/scene_keys.hpp"
#include "core/config/scene.hpp"

namespace perifrac::test {

namespace {

const std::string scene_file = PERIFRAC_SOURCE_DIR "/configs/mandel.yaml";

}  // namespace

double MandelRun::largest_pressure_error(double from_time, double to_time) const {
  double largest = 0.0;
  for (const Row& row : rows) {
    if (row.dimensionless_time > 0.999 * from_time && row.dimensionless_time < 1.001 * to_time) {
      largest = std::max(largest, row.pressure_error);
    }
  }
  return largest;
}

double MandelRun::largest_plate_error() const {
  return std::ranges::max(rows, {}, &Row::plate_error).plate_error;
}

Simulation make_mandel(const std::vector<std::string>& overrides) {
  Simulation simulation = make_simulation(read_scene(scene_file, overrides, scene_catalogue()));
  simulation.manager->initialize(0.0);
  return simulation;
}

MandelRun run_mandel(const std::vector<std::string>& overrides) {
  const Section scene = read_scene(scene_file, overrides, scene_catalogue());
  Simulation simulation = make_simulation(scene);
  CouplingManager& manager = *simulation.manager;
  manager.initialize(0.0);
  MandelReference reference(scene, simulation);
  MandelRun run;
  const auto begin = std::chrono::steady_clock::now();
  manager.settle();
  for (const double output : read_output_times(scene.at("output"), simulation.end)) {
    while (manager.time() < output) {
      const std::int64_t passes = manager.work().passes;
      manager.advance(output);
      run.most_passes = std::max(run.most_passes, manager.work().passes - passes);
      reference.record_window(manager.time());
    }
    reference.record_output(manager.time());
  }
  run.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const nlohmann::json summary = reference.summary();
  for (const auto& row : summary["table"]) {
    run.rows.push_back({row["dimensionless_time"], row["pressure_error"], row["plate_error"]});
  }
  if (summary.contains("quantities")) run.peak_error = summary["quantities"][0]["max_error"];
  for (const ModuleSlot& slot : manager.modules()) {
    if (slot.name == "solid") run.solid_solves = slot.advances;
  }
  run.mass_error = manager.ledger().mass()->relative_error;
  run.energy_error = manager.ledger().energy()->relative_error;
  const auto pressure = field_named(manager, "pore_pressure").values();
  run.pressure.assign(pressure.begin(), pressure.end());
  return run;
}

}  // namespace perifrac::test
