#include "app/run.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/energy_warnings.hpp"
#include "app/nucleus_warning.hpp"
#include "app/output_times.hpp"
#include "app/profile_report.hpp"
#include "app/recorder.hpp"
#include "app/report.hpp"
#include "app/scene_keys.hpp"
#include "app/simulation.hpp"
#include "app/summary.hpp"
#include "app/version.hpp"
#include "core/config/scene.hpp"
#include "core/config/units.hpp"
#include "core/errors.hpp"
#include "core/io/log.hpp"
#include "core/io/progress.hpp"
#include "core/io/signals.hpp"

namespace perifrac {

namespace {

// Between outputs, every so many windows are a point to restart from, so that a signal costs
// little of a long run. A fixed number: it is part of what makes runs equal bit for bit.
constexpr std::int64_t windows_between_restart_points = 50;

Section read(const RunRequest& request) {
  const ProfilePart profiled("scene");
  return read_scene(request.scene, request.overrides, scene_catalogue());
}

Simulation set_up(const Section& scene) {
  const ProfilePart profiled("set-up");
  Simulation simulation = make_simulation(scene);
  initialize(scene, simulation);
  return simulation;
}

/// The scene as run: what a checkpoint belongs to.
std::string scene_text(const RunRequest& request) {
  std::ifstream file(request.scene);
  std::ostringstream text;
  text << file.rdbuf();
  for (const std::string& override : request.overrides) text << "# --set " << override << '\n';
  return text.str();
}

/// The time [s] that --until names. The scene's own end stays what it is: windows follow from it.
std::optional<double> read_until(const std::string& until) {
  if (until.empty()) return {};
  try {
    if (const double time = to_si(until, "s"); time > 0.0) return time;
  } catch (const QuantityError& error) {
    throw InputError(fmt::format("--until: {}", error.what()));
  }
  throw InputError(fmt::format("--until: '{}' is out of range; expected a time after 0 s", until));
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
  if (checkpoint.version != version) {
    throw InputError(fmt::format("{}: was written by perifrac {}, this is {}; expected the same",
                                 request.restart, checkpoint.version, version));
  }
  // At the end itself a run may still lack its summary.
  if (checkpoint.time > end) {
    throw InputError(
        fmt::format("{}: lies at {:g} s, the run ends at {:g} s; expected a later "
                    "end, as by --until",
                    request.restart, checkpoint.time, end));
  }
  return checkpoint;
}

std::filesystem::path folder_of(const RunRequest& request) {
  if (!request.output.empty()) return request.output;
  if (!request.restart.empty()) return std::filesystem::absolute(request.restart).parent_path();
  return std::filesystem::path("runs") / std::filesystem::path(request.scene).stem();
}

/// A restart goes on with the rows and frames in its folder: they must be of the same run.
void refuse_other_results(const RunRequest& request, const std::filesystem::path& folder) {
  const auto own_folder = std::filesystem::absolute(request.restart).parent_path();
  std::error_code missing;
  if (!std::filesystem::exists(folder / "history.csv", missing) ||
      std::filesystem::equivalent(folder, own_folder, missing)) {
    return;
  }
  throw InputError(fmt::format(
      "{}: holds results, and {} is not among them; expected a new folder, or the checkpoint's",
      folder.string(), request.restart));
}

/// Moves the simulation to its end, or until a signal comes; returns the signal or 0.
int advance_to_end(Simulation& simulation, Recorder& recorder, std::span<const double> outputs) {
  CouplingManager& manager = *simulation.manager;
  Progress progress(manager.time(), simulation.end);
  auto output = std::ranges::upper_bound(outputs, manager.time());
  while (output != outputs.end()) {
    if (const int signal = received_signal()) return signal;
    manager.advance(*output);
    if (const auto warning = manager.new_warning()) log_warning(*warning);
    recorder.check_finite();
    recorder.record_window();
    if (manager.time() == *output) {
      recorder.record_output();
      recorder.restart_point();
      ++output;
    } else if (manager.step() % windows_between_restart_points == 0) {
      recorder.restart_point();
    }
    recorder.write_checkpoint(true);
    progress.update(manager.time(), manager.step());
  }
  return 0;
}

void start(const Section& scene, Simulation& simulation, Recorder& recorder,
           const OutputFolder& folder, const std::optional<Checkpoint>& restart) {
  CouplingManager& manager = *simulation.manager;
  for (const std::string& warning : manager.warnings()) log_warning(warning);
  if (restart) {
    recorder.restore(*restart);
    recorder.open(folder, restart);
    return;
  }
  if (const auto warning = start_warning(scene, simulation, manager.settle())) {
    log_warning(*warning);
  }
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
  std::optional<Profile> profile;
  if (request.profile) profile.emplace();
  hold_back_signals();
  const Section scene = read(request);
  const std::string text = scene_text(request);
  Simulation simulation = set_up(scene);
  if (const auto warning = nucleus_warning(scene)) log_warning(*warning);
  const std::vector<double> outputs =
      read_output_times(scene.at("output"), simulation.end, read_until(request.until));
  simulation.end = outputs.back();
  Recorder recorder(scene, text, simulation);
  const std::optional<Checkpoint> restart = read_restart(request, text, simulation.end);
  if (restart) refuse_other_results(request, folder_of(request));
  const OutputFolder folder(folder_of(request));
  if (!restart) folder.remove_earlier_results();

  RunOutcome outcome = RunOutcome::done;
  int exit_code = 0;
  try {
    start(scene, simulation, recorder, folder, restart);
    if (const int signal = advance_to_end(simulation, recorder, outputs)) {
      outcome = RunOutcome::stopped;
      exit_code = exit_code_of(signal);
    }
    if (const auto warning = balance_warning(scene, simulation)) log_warning(*warning);
  } catch (const NumericalError& error) {
    log_error(error.what());
    outcome = RunOutcome::failed;
    exit_code = 1;
  }
  recorder.write_checkpoint(false);
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  nlohmann::json summary = summarize(scene, request.scene, text, simulation, recorder.reference(),
                                     outcome, {.whole = seconds, .output = recorder.seconds()});
  if (profile) summary["profile"] = profile_json(*profile, simulation);
  write_summary(folder.path(), summary);
  if (request.json) {
    fmt::print("{}", json_text(summary));
  } else {
    fmt::print("{}", summary_text(summary));
    if (recorder.reference()) fmt::print("\n{}", recorder.reference()->table());
  }
  std::fflush(stdout);
  if (profile) fmt::print(stderr, "{}", profile_text(summary["profile"]));
  if (request.report && outcome != RunOutcome::stopped &&
      make_report(folder.path(), request.json) != 0) {
    log_warning("no report was made of the results; `perifrac report` tries again");
  }
  return exit_code;
}

}  // namespace perifrac
