#include "app/run/scene_run.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/run/scene_echo.hpp"
#include "app/warnings/energy_warnings.hpp"
#include "app/warnings/spread_fluid.hpp"
#include "core/base/errors.hpp"
#include "core/io/log.hpp"

namespace perifrac {

namespace {

// So many windows after the last point to restart from is the next, so that a signal costs little
// of a long run; an output is one after fewer. Not every output: CVODE begins anew there, and were
// outputs close its result would follow them. Fixed numbers: they are part of what makes runs equal
// bit for bit.
constexpr std::int64_t windows_between_restart_points = 50, windows_before_an_output = 10;

void log_all(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) log_warning(warning);
}

void log_if_any(const std::optional<std::string>& warning) {
  if (warning) log_warning(*warning);
}

/// Ends a run whose windows were seen not to be stable once nothing is left of its answer.
void require_balance(const CouplingManager& manager) {
  if (!manager.is_unstable()) return;
  constexpr double nonsense = 0.5;
  const auto energy = manager.ledger().energy();
  if (!energy || energy->relative_error < nonsense) return;
  throw NumericalError("energy", "the ledger", manager.time(),
                       fmt::format("windows of one pass are not stable: the balance is {:.0f} % "
                                   "open",
                                   100.0 * energy->relative_error));
}

}  // namespace

SceneRun::SceneRun(const Section& scene, std::string text, Simulation& simulation,
                   std::vector<double> outputs)
    : scene_(scene),
      text_(std::move(text)),
      simulation_(simulation),
      outputs_(std::move(outputs)),
      recorder_(scene, text_, simulation),
      watch_(scene, simulation),
      filling_(scene, simulation) {}

void SceneRun::start(const std::filesystem::path& folder,
                     const std::optional<Checkpoint>& restart) {
  CouplingManager& manager = *simulation_.manager;
  log_all(manager.warnings());
  if (restart) {
    recorder_.restore(*restart);
    if (!folder.empty()) recorder_.open(folder, restart);
    return;
  }
  log_if_any(start_warning(scene_, simulation_, manager.settle()));
  recorder_.check_finite();
  if (!folder.empty()) recorder_.open(folder, restart);
  recorder_.record_window();
  recorder_.record_output();
  recorder_.restart_point();
  recorder_.write_checkpoint(false);
}

void SceneRun::advance(double stop) {
  CouplingManager& manager = *simulation_.manager;
  const double output = *std::ranges::upper_bound(outputs_, manager.time());
  manager.advance(std::min(output, stop));
  log_if_any(manager.new_warning());
  recorder_.check_finite();
  recorder_.record_window();
  require_balance(manager);
  const bool is_output = manager.time() == output;
  const bool is_restart_point =
      recorder_.windows_since_restart_point() >=
      (is_output ? windows_before_an_output : windows_between_restart_points);
  if (is_output || is_restart_point || ValidityWatch::is_due(manager.step())) {
    log_all(watch_.look(is_output));
    filling_.look();
  }
  if (is_output) {
    recorder_.record_output();
    recorder_.check_mass();
  }
  if (is_restart_point) recorder_.restart_point();
}

void SceneRun::settle() {
  recorder_.restart_point();  // integrators forget the load that was
  simulation_.manager->settle();
  recorder_.check_finite();
  recorder_.restart_point();
}

void SceneRun::finish(bool stopped) {
  log_all(watch_.look(true));
  log_if_any(balance_warning(scene_, simulation_));
  filling_.look();
  log_if_any(filling_.warning());
  log_if_any(closed_front_warning(scene_, simulation_));
  log_if_any(leaked_away_warning(scene_, simulation_));
  log_if_any(residual_aperture_warning(scene_, simulation_));
  log_if_any(spread_fluid_warning(scene_, simulation_));
  if (!stopped) {
    log_if_any(seepage_warning(scene_, simulation_));
    log_if_any(wave_warning(scene_, simulation_.manager->time()));
  }
  recorder_.write_checkpoint(false);
  recorder_.check_kept();
}

RunEnd SceneRun::fail(const std::exception& error) {
  RunEnd end{.outcome = RunOutcome::failed, .failure = failure_of(error)};
  log_error(describe(*end.failure));
  if (!end.failure->time) return end;
  log_all(watch_.look(true));  // what it had come to may say why
  recorder_.record_failure();
  recorder_.write_checkpoint(false);
  return end;
}

nlohmann::json SceneRun::summary(const std::string& file, const RunEnd& end, double whole) const {
  nlohmann::json summary = summarize(scene_, file, text_, simulation_, recorder_.reference(), end,
                                     {.whole = whole, .output = recorder_.seconds()});
  summary["read"] = what_was_read(scene_, simulation_);
  return summary;
}

}  // namespace perifrac
