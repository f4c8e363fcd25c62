#include "app/run/check.hpp"

#include <chrono>
#include <cmath>
#include <new>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/run/array_list.hpp"
#include "app/run/build_info.hpp"
#include "app/run/check_text.hpp"
#include "app/run/coarse_twin.hpp"
#include "app/run/forecast.hpp"
#include "app/run/memory.hpp"
#include "app/run/output_times.hpp"
#include "app/run/recorder.hpp"
#include "app/run/scene_echo.hpp"
#include "app/run/scene_keys.hpp"
#include "app/run/setup_picture.hpp"
#include "app/run/summary.hpp"
#include "app/simulation/outside_modules.hpp"
#include "app/simulation/simulation.hpp"
#include "app/warnings/resolution_warnings.hpp"
#include "app/warnings/scene_regime.hpp"
#include "app/warnings/scene_warnings.hpp"
#include "core/base/ranks.hpp"
#include "core/config/mistakes.hpp"
#include "core/config/scene.hpp"

namespace perifrac {

namespace {

nlohmann::json modules_of(const CouplingManager& manager) {
  nlohmann::json modules = nlohmann::json::array();
  for (const ModuleSlot& slot : manager.modules()) modules.push_back(slot.name);
  return modules;
}

/// How each module goes over the bonds.
nlohmann::json paths_of(const CouplingManager& manager) {
  nlohmann::json paths = nlohmann::json::object();
  for (const ModuleSlot& slot : manager.modules()) {
    if (const std::string path = slot.module->path(); !path.empty()) paths[slot.name] = path;
  }
  return paths;
}

nlohmann::json links_of(const CouplingManager& manager) {
  nlohmann::json links = nlohmann::json::array();
  for (const Link& link : manager.links()) links.push_back(link.name());
  return links;
}

nlohmann::json regime_json(const SceneRegime& regime) {
  const HydraulicFracture& fracture = regime.fracture;
  const auto with_unit = [](double value, const char* unit) {
    return nlohmann::json{{"value", value}, {"unit", unit}};
  };
  const double toughness = fracture.driven.dimensionless_toughness();
  const double kept = efficiency(fracture, regime.time);
  const CrackSize crack = expected_crack(fracture, regime.time);
  return {{"corner", corner(toughness, kept)},
          {"dimensionless_toughness", toughness},
          {"leak_off_number", leak_off_number(fracture, regime.time)},
          {"leak_off_over_toughness",
           leak_off_over_toughness(fracture, 0.5 * regime.wings, regime.time)},
          {"efficiency", kept},
          {"lag_time", with_unit(lag_time(fracture), "s")},
          {"largest_lag", with_unit(largest_lag(fracture, regime.time), "m")},
          {"time", with_unit(regime.time, "s")},
          {"length", with_unit(crack.length, "m")},
          {"inlet_opening", with_unit(crack.opening, "m")},
          {"net_inlet_pressure", with_unit(crack.pressure, "Pa")}};
}

/// Those of cracks from the start are part of them.
std::optional<double> facets_at_end(const Simulation& simulation, std::optional<double> size) {
  if (!size) return {};
  return *size / facet_size(simulation);
}

/// Of the crack in an infinite body.
std::optional<double> length_at_end(const std::optional<SceneRegime>& regime) {
  if (!regime) return {};
  return regime->wings * expected_crack(regime->fracture, regime->time).length;
}

nlohmann::json forecast_json(const Forecast& forecast) {
  const auto& parts = forecast.seconds_by_part;
  const auto largest =
      std::ranges::max_element(parts, {}, [](const auto& part) { return part.second; });
  nlohmann::json by_part = nlohmann::json::object();
  for (const auto& [name, seconds] : parts) by_part[name] = seconds;
  nlohmann::json result = {{"seconds", forecast.seconds},
                           {"seconds_by_part", by_part},
                           {"most_in", largest->first},
                           {"windows", forecast.windows},
                           {"peak_memory", forecast.memory},
                           {"processes", ranks::count()},
                           {"trial",
                            {{"time", forecast.trial_time},
                             {"seconds", forecast.trial_seconds},
                             {"is_whole", forecast.is_whole}}}};
  if (forecast.failure) result["failure"] = *forecast.failure;
  return result;
}

/// What is known of a scene without building it, where that takes more memory than there is.
nlohmann::json unbuilt(const Section& scene, const MemoryEstimate& estimate) {
  return {{"effects", effects(scene)},
          {"counts", {{"points", std::llround(estimate.points)}}},
          {"warnings", scene_warnings(scene, {})}};
}

nlohmann::json built(const CheckRequest& request, const Section& scene) {
  const auto begin = std::chrono::steady_clock::now();
  Simulation simulation;
  std::vector<double> outputs;
  Mistakes mistakes;
  mistakes.note([&] {
    simulation = make_simulation(scene);
    initialize(scene, simulation);
  });
  mistakes.note([&] { outputs = read_output_times(scene.at("output"), scene.number("time.end")); });
  mistakes.throw_if_any();
  CouplingManager& manager = *simulation.manager;
  if (!request.picture.empty()) {
    ranks::on_first([&] { draw_setup(scene, simulation, request.picture); });
  }
  const Recorder recorder(scene, "", simulation);
  ArrayList list;
  manager.visit_state(list);
  nlohmann::json result = {{"modules", modules_of(manager)},
                           {"effects", effects(scene)},
                           {"read", what_was_read(scene, simulation)},
                           {"links", links_of(manager)},
                           {"bond_loops", paths_of(manager)},
                           {"instructions", instruction_set()},
                           {"counts", counts(simulation)},
                           {"family_bytes", family_bytes(simulation.body)},
                           {"arrays", list.arrays},
                           {"warnings", manager.warnings()}};
  const std::optional<SceneRegime> regime = regime_of(scene, simulation);
  if (regime) {
    result["regime"] = regime_json(*regime);
    for (const std::string& note : regime->notes) result["warnings"].push_back(note);
  }
  for (const std::string& warning : scene_warnings(scene, regime)) {
    result["warnings"].push_back(warning);
  }
  for (const auto& warning : {seepage_warning(scene, scene.number("time.end")),
                              wave_warning(scene, scene.number("time.end"))}) {
    if (warning) result["warnings"].push_back(*warning);
  }
  if (!(request.trial_seconds > 0.0)) return result;
  const double building =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  std::optional<double> size;
  if (!regime || !regime->is_as_in_infinite_body) {
    size =
        crack_size_of_coarse_twin(request.scene, request.overrides, scene, request.trial_seconds);
  }
  if (!size) size = length_at_end(regime);
  result["forecast"] = forecast_json(forecast(simulation, outputs, request.trial_seconds, building,
                                              facets_at_end(simulation, size)));
  if (size) {
    const bool is_area = scene.integer("dimension") == 3;
    result["forecast"][is_area ? "crack_area" : "crack_length"] = {{"value", *size},
                                                                   {"unit", is_area ? "m^2" : "m"}};
  }
  return result;
}

/// Built where there is memory for it: the system ends a process that takes more, without a word.
nlohmann::json built_if_it_fits(const CheckRequest& request, const Section& scene) {
  const double available = available_memory();
  const auto estimate = estimate_memory(scene);
  const auto warn = [&](nlohmann::json result, const std::string& what) {
    result["warnings"].push_back(what);
    if (!request.picture.empty()) result["warnings"].push_back("no picture: nothing was built");
    return result;
  };
  if (ranks::largest(estimate && estimate->bytes > available) != 0) {
    return warn(unbuilt(scene, *estimate),
                "too large to be tried here: a run takes " + describe(*estimate, available));
  }
  keep_to_free_memory();
  try {
    return built(request, scene);
  } catch (const std::bad_alloc&) {
    return warn(unbuilt(scene, estimate.value_or(MemoryEstimate{})),
                fmt::format("the trial ran out of memory: a run takes more than the {:.2g} GB that "
                            "were free",
                            1e-9 * available));
  }
}

}  // namespace

int check_scene(const CheckRequest& request) {
  if (!request.picture.empty()) check_picture_name(request.picture);
  load_outside_modules(request.scene, request.overrides);
  const Section scene = read_scene(request.scene, request.overrides, scene_catalogue());
  nlohmann::json result = built_if_it_fits(request, scene);
  result["scene"] = request.scene;
  if (scene.has("title")) result["title"] = scene.text("title");
  if (const auto estimate = estimate_memory(scene)) {
    result["memory"] = {{"estimate", estimate->bytes}, {"available", available_memory()}};
  }
  if (request.json) {
    fmt::print("{}", json_text(result));
  } else {
    print_check(result, request.arrays);
  }
  return 0;
}

}  // namespace perifrac
