#include "app/run.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/output_times.hpp"
#include "app/recorder.hpp"
#include "app/report.hpp"
#include "app/scene_keys.hpp"
#include "app/simulation.hpp"
#include "app/summary.hpp"
#include "core/config/scene.hpp"
#include "core/errors.hpp"
#include "core/io/log.hpp"
#include "core/io/progress.hpp"
#include "core/io/signals.hpp"

namespace perifrac {

namespace {

// Between outputs, every so many windows are a point to restart from, so that a signal costs
// little of a long run. A fixed number: it is part of what makes runs equal bit for bit.
constexpr std::int64_t windows_between_restart_points = 50;

/// The scene as run: what a checkpoint belongs to.
std::string scene_text(const RunRequest& request) {
  std::ifstream file(request.scene);
  std::ostringstream text;
  text << file.rdbuf();
  for (const std::string& override : request.overrides) text << "# --set " << override << '\n';
  return text.str();
}

Section read_request(const RunRequest& request) {
  std::vector<std::string> overrides = request.overrides;
  if (!request.until.empty()) overrides.push_back("time.end=" + request.until);
  return read_scene(request.scene, overrides, scene_catalogue());
}

std::optional<Checkpoint> read_restart(const RunRequest& request, const std::string& text,
                                       double end) {
  if (request.restart.empty()) return {};
  Checkpoint checkpoint = read_checkpoint(request.restart);
  if (checkpoint.scene != text) {
    throw InputError(fmt::format(
        "{}: was written by another scene than {}; expected the scene, and --set, that it came "
        "from (only --until may differ)",
        request.restart, request.scene));
  }
  if (checkpoint.time >= end) {
    throw InputError(
        fmt::format("{}: lies at {:g} s, the run ends at {:g} s; expected a later "
                    "end, as by --until",
                    request.restart, checkpoint.time, end));
  }
  return checkpoint;
}

std::filesystem::path folder_of(const RunRequest& request) {
  if (!request.output.empty()) return request.output;
  return std::filesystem::path("runs") / std::filesystem::path(request.scene).stem();
}

/// Moves the simulation to its end, or until a signal comes; returns the signal or 0.
int advance_to_end(Simulation& simulation, Recorder& recorder, std::span<const double> outputs) {
  CouplingManager& manager = *simulation.manager;
  Progress progress(manager.time(), simulation.end);
  auto output = std::ranges::upper_bound(outputs, manager.time());
  while (output != outputs.end()) {
    manager.advance(*output);
    recorder.check_finite();
    recorder.record_window();
    if (manager.time() == *output) {
      recorder.record_output();
      recorder.restart_point();
      recorder.write_checkpoint(true);
      ++output;
    } else if (manager.step() % windows_between_restart_points == 0) {
      recorder.restart_point();
    }
    progress.update(manager.time(), manager.step());
    if (const int signal = received_signal()) return signal;
  }
  return 0;
}

void start(Simulation& simulation, Recorder& recorder, const OutputFolder& folder,
           const std::optional<Checkpoint>& restart) {
  CouplingManager& manager = *simulation.manager;
  for (const std::string& warning : manager.warnings()) log_warning(warning);
  if (restart) {
    recorder.restore(*restart);
    recorder.open(folder, restart);
    return;
  }
  manager.settle();
  recorder.check_finite();
  recorder.open(folder, restart);
  recorder.record_window();
  recorder.record_output();
  recorder.restart_point();
  recorder.write_checkpoint(false);
}

}  // namespace

int run_scene(const RunRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  install_signal_handlers();
  const Section scene = read_request(request);
  const std::string text = scene_text(request);
  Simulation simulation = make_simulation(scene);
  simulation.manager->initialize(0.0);
  const std::vector<double> outputs = read_output_times(scene.at("output"), simulation.end);
  Recorder recorder(scene, text, simulation);
  const std::optional<Checkpoint> restart = read_restart(request, text, simulation.end);
  const OutputFolder folder(folder_of(request));
  if (!restart) folder.remove_earlier_results();

  RunOutcome outcome = RunOutcome::done;
  int exit_code = 0;
  try {
    start(simulation, recorder, folder, restart);
    if (const int signal = advance_to_end(simulation, recorder, outputs)) {
      outcome = RunOutcome::stopped;
      exit_code = exit_code_of(signal);
    }
  } catch (const NumericalError& error) {
    log_error(error.what());
    outcome = RunOutcome::failed;
    exit_code = 1;
  }
  recorder.write_checkpoint(false);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  const nlohmann::json summary =
      summarize(scene, request.scene, text, simulation, recorder.reference(), outcome, seconds);
  write_summary(folder.path(), summary);
  if (request.json) {
    fmt::print("{}\n", summary.dump(2));
  } else {
    fmt::print("{}", summary_text(summary));
    if (recorder.reference()) fmt::print("\n{}", recorder.reference()->table());
  }
  std::fflush(stdout);
  if (request.report && outcome != RunOutcome::stopped) make_report(folder.path(), request.json);
  return exit_code;
}

}  // namespace perifrac
