#include "app/run/run.hpp"

#include <chrono>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "app/report/report.hpp"
#include "app/report/watch.hpp"
#include "app/run/live_line.hpp"
#include "app/run/memory.hpp"
#include "app/run/output_times.hpp"
#include "app/run/profile_report.hpp"
#include "app/run/progress_file.hpp"
#include "app/run/scene_echo.hpp"
#include "app/run/scene_keys.hpp"
#include "app/run/scene_run.hpp"
#include "app/run/summary.hpp"
#include "app/run/version.hpp"
#include "app/simulation/outside_modules.hpp"
#include "app/simulation/simulation.hpp"
#include "app/warnings/scene_warnings.hpp"
#include "core/base/errors.hpp"
#include "core/base/ranks.hpp"
#include "core/config/mistakes.hpp"
#include "core/config/scene.hpp"
#include "core/config/units.hpp"
#include "core/io/input_file.hpp"
#include "core/io/log.hpp"
#include "core/io/progress.hpp"
#include "core/io/signals.hpp"

namespace perifrac {

namespace {

Section read(const RunRequest& request) {
  const ProfilePart profiled("scene");
  load_outside_modules(request.scene, request.overrides);
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
  std::string text = read_input_text(request.scene, "a scene file");
  for (const std::string& override : request.overrides) text += "# --set " + override + '\n';
  return text;
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
int advance_to_end(const Simulation& simulation, SceneRun& run, ProgressFile& file) {
  const CouplingManager& manager = *simulation.manager;
  Progress progress(manager.time(), simulation.end);
  file.update(manager.time(), manager.step());
  const auto words = live_words(manager);
  while (!run.is_done()) {
    const auto signal = static_cast<int>(ranks::largest(received_signal()));
    if (signal != 0) return signal;
    run.advance();
    run.write_checkpoint(!checkpoint_requested());
    progress.update(manager.time(), manager.step(), words);
    file.update(manager.time(), manager.step());
  }
  return 0;
}

void replace_earlier_results(const OutputFolder& folder) {
  const int files = folder.remove_earlier_results();
  if (files == 0) return;
  log_info(
      fmt::format("{}: {} files of an earlier run are replaced", folder.path().string(), files));
}

/// Runs `whole`, which returns the signal that stopped it or 0.
template <class Whole>
RunEnd go(Whole&& whole, SceneRun& run) {
  RunEnd end;
  try {
    if (whole() != 0) end.outcome = RunOutcome::stopped;
    return end;
  } catch (const InputError&) {
    throw;
  } catch (const OutputError&) {
    throw;  // the summary would fare no better
  } catch (const std::exception& error) {
    return run.fail(error);
  }
}

/// How a run ended, since when it ran, and what it cost by part.
struct Ending {
  RunEnd end;
  std::chrono::steady_clock::time_point begin;
  std::optional<Profile>& profile;
};

/// Writes the summary, and says and draws what there is.
void conclude(const RunRequest& request, Simulation& simulation, const SceneRun& run,
              const std::filesystem::path& folder, const Ending& ending) {
  const double seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - ending.begin).count();
  nlohmann::json summary = run.summary(request.scene, ending.end, seconds);
  if (ending.profile) summary["profile"] = profile_json(*ending.profile, simulation);
  ranks::on_first([&] { write_summary(folder, summary); });
  if (request.json) {
    fmt::print("{}", json_text(summary));
  } else {
    const std::string crack = crack_size(*simulation.manager);
    fmt::print("{}{}", outcome_text(summary), crack.empty() ? "" : "  " + crack + "\n");
    if (run.recorder().reference()) fmt::print("{}", run.recorder().reference()->table());
    fmt::print("{}", work_text(summary));
  }
  std::fflush(stdout);
  if (ending.profile) fmt::print(stderr, "{}", profile_text(summary["profile"]));
  if (!request.report || ending.end.outcome == RunOutcome::stopped) return;
  ranks::on_first([&] {
    if (make_report(folder, request.json) == 0) return;
    log_warning("no report was made of the results; `perifrac report` tries again");
  });
}

}  // namespace

int run_scene(const RunRequest& request) {
  const auto begin = std::chrono::steady_clock::now();
  std::optional<Profile> profile;
  if (request.profile) profile.emplace();
  hold_back_signals();
  const Section scene = read(request);
  const std::string text = scene_text(request);
  require_memory(scene);
  Simulation simulation;
  std::vector<double> outputs;
  Mistakes mistakes;
  mistakes.note([&] { simulation = set_up(scene); });
  mistakes.note([&] {
    outputs =
        read_output_times(scene.at("output"), scene.number("time.end"), read_until(request.until));
  });
  mistakes.throw_if_any();
  const auto warnings = scene_warnings(scene, regime_of(scene, simulation));
  simulation.end = outputs.back();
  SceneRun run(scene, text, simulation, outputs);
  const std::optional<Checkpoint> restart = read_restart(request, text, simulation.end);
  if (restart) refuse_other_results(request, folder_of(request));
  ranks::wait_for_all();  // what there is has been read
  const std::filesystem::path folder = folder_of(request);
  std::optional<OutputFolder> held;
  ranks::on_first([&] {
    held.emplace(folder, request.overwrite);
    if (!restart) replace_earlier_results(*held);
  });
  if (!request.json) fmt::print("{}\n", fmt::join(what_was_read(scene, simulation), "\n"));
  for (const std::string& warning : warnings) log_warning(warning);
  std::optional<Watcher> watcher;
  if (request.watch && ranks::is_first()) watcher.emplace(folder);
  std::optional<ProgressFile> progress;

  int signal = 0;
  const RunEnd end = go(
      [&] {
        run.start(folder, restart);
        progress.emplace(folder, simulation.manager->time(), simulation.end, [&] {
          return summarize(scene, request.scene, text, simulation, nullptr, {},
                           {.whole = 0.0, .output = run.recorder().seconds()});
        });
        signal = advance_to_end(simulation, run, *progress);
        run.finish(signal != 0);
        return signal;
      },
      run);
  // Of memory that ended, nothing that is left to do is sure; what the log said last stays true.
  try {
    conclude(request, simulation, run, folder, {end, begin, profile});
  } catch (const std::bad_alloc&) {
    if (!end.failure) throw;
  }
  if (end.failure) return 1;
  return signal == 0 ? 0 : exit_code_of(signal);
}

}  // namespace perifrac
