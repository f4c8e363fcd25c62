#include "tests/verification/mandel_run.hpp"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "app/run/scene_keys.hpp"
#include "core/config/scene.hpp"
#include "tests/verification/scene_run.hpp"

namespace perifrac::test {

namespace {

std::string scene_file(const std::string& name) {
  return std::string(PERIFRAC_SOURCE_DIR "/configs/") + name + ".yaml";
}

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
  Simulation simulation =
      make_simulation(read_scene(scene_file("mandel"), overrides, scene_catalogue()));
  simulation.manager->initialize(0.0);
  return simulation;
}

MandelRun run_mandel(const std::vector<std::string>& overrides, const std::string& scene) {
  MandelRun run;
  const SceneRun of_scene = run_config(scene, overrides);
  const nlohmann::json& summary = of_scene.summary;
  run.exit_code = of_scene.exit_code;
  for (const auto& row : summary["reference"]["table"]) {
    run.rows.push_back({row["dimensionless_time"], row["pressure_error"], row["plate_error"]});
  }
  if (summary["reference"].contains("quantities")) {
    run.peak_error = summary["reference"]["quantities"][0]["max_error"];
  }
  for (const auto& module : summary["modules"]) {
    if (module["name"] == "solid") run.solid_solves = module["advances"];
    run.seconds += module["wall_time"].get<double>();
  }
  run.most_passes = summary["counts"]["most_passes"];
  run.mass_error = summary["ledger"]["mass_error"];
  run.energy_error = summary["ledger"]["energy_error"];
  run.profile = summary["reference"]["profiles"][0]["computed"];
  return run;
}

}  // namespace perifrac::test
