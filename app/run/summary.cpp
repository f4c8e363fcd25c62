#include "app/run/summary.hpp"

#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <omp.h>

#include "app/run/build_info.hpp"
#include "app/run/memory.hpp"
#include "app/run/version.hpp"
#include "app/simulation/register_modules.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/log.hpp"

namespace perifrac {

namespace {

const char* word(RunOutcome outcome) {
  switch (outcome) {
    case RunOutcome::done:
      return "done";
    case RunOutcome::failed:
      return "failed";
    default:
      return "stopped";
  }
}

/// What the process has used of this machine so far.
rusage usage() {
  rusage used{};
  getrusage(RUSAGE_SELF, &used);
  return used;
}

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

nlohmann::json ledger_summary(const Ledger& ledger) {
  nlohmann::json result = nlohmann::json::object();
  for (const LedgerColumn& column : ledger.columns()) {
    result[column.name] = {{"value", column.value}, {"unit", column.unit}};
  }
  if (const auto mass = ledger.mass()) result["mass_error"] = mass->relative_error;
  if (const auto energy = ledger.energy()) result["energy_error"] = energy->relative_error;
  return result;
}

/// What the module's solvers did, those that did nothing left out.
nlohmann::json statistics(const ModuleSlot& slot) {
  nlohmann::json result = nlohmann::json::object();
  PhysicsModule& module = *slot.module;
  if (slot.factors.factorisations > 0) result["factorisations"] = slot.factors.factorisations;
  if (slot.factors.solves > 0) result["solves"] = slot.factors.solves;
  const auto ports = module.ports();
  for (std::size_t id = 0; id < ports.size(); ++id) {
    if (ports[id].role != PortRole::work) continue;
    const double count = module.port(static_cast<PortId>(id)).value[0];
    if (count > 0.0) result[ports[id].name] = count;
  }
  return result;
}

nlohmann::json failure_summary(const Failure& failure) {
  nlohmann::json result = {{"error", failure.error}};
  if (failure.time) {
    result["field"] = failure.field;
    result["place"] = failure.place;
    result["time"] = {{"value", *failure.time}, {"unit", "s"}};
  }
  if (!failure.advice.empty()) result["advice"] = failure.advice;
  return result;
}

nlohmann::json modules_summary(const Section& scene, const CouplingManager& manager) {
  nlohmann::json result = nlohmann::json::array();
  for (const ModuleSlot& slot : manager.modules()) {
    result.push_back({{"name", slot.name},
                      {"type", scene.word(slot.name + ".type")},
                      {"wall_time", slot.seconds},
                      {"cpu_time", slot.cpu_seconds},
                      {"advances", slot.advances},
                      {"statistics", statistics(slot)}});
  }
  return result;
}

}  // namespace

std::vector<std::string> effects(const Section& scene) {
  std::vector<std::string> result;
  for (const std::string& physics : physics_of(scene)) {
    result.push_back(physics + ": " + scene.word(physics + ".type"));
  }
  return result;
}

nlohmann::json counts(const Simulation& simulation) {
  std::size_t points = 0, bonds = 0, ghosts = 0;
  const auto count_body = [&](const auto& body) {
    if (!body) return;
    points = body->points().size();
    for (const auto& family : body->families()) {
      bonds += family->steps.total();
      ghosts += family->ghost_source.size();
    }
  };
  std::visit(count_body, simulation.body);
  nlohmann::json result = {{"points", points}, {"ghosts", ghosts}, {"bonds", bonds}};
  for (const Field& field : fields_of(*simulation.manager)) {
    const PointSet& set = field.points();
    const bool of_body = simulation.has_body() && set.name == simulation.points().name;
    if (set.dimension > 0 && !of_body) result[set.name + "_points"] = set.count;
  }
  return result;
}

nlohmann::json summarize(const Section& scene, const std::string& scene_file,
                         const std::string& scene_text, Simulation& simulation,
                         const Reference* reference, const RunEnd& end, const WallTime& wall) {
  const CouplingManager& manager = *simulation.manager;
  const rusage used = usage();
  nlohmann::json result = {{"scene",
                            {{"title", scene.has("title") ? scene.text("title") : ""},
                             {"path", scene_file},
                             {"text", scene_text}}},
                           {"version", version},
                           {"build", build_info()},
                           {"machine", machine_info()},
                           {"dimension", scene.integer("dimension")},
                           {"outcome", word(end.outcome)},
                           {"time", {{"value", manager.time()}, {"unit", "s"}}},
                           {"effects", effects(scene)},
                           {"counts", counts(simulation)},
                           {"modules", modules_summary(scene, manager)},
                           {"wall_time", wall.whole},
                           {"output_time", wall.output},
                           {"cpu_time", seconds(used.ru_utime) + seconds(used.ru_stime)},
                           {"threads", omp_get_max_threads()},
                           {"peak_memory", peak_memory()},
                           {"ledger", ledger_summary(manager.ledger())},
                           {"warnings", logged_warnings()}};
  if (end.failure) result["failure"] = failure_summary(*end.failure);
  result["counts"]["windows"] = manager.step();
  result["counts"]["passes"] = manager.work().passes;
  result["counts"]["most_passes"] = manager.work().most_passes;
  result["coupling"] = {{"iterations", manager.most_passes()},
                        {"window_cuts", manager.work().cuts}};
  if (reference) result["reference"] = reference->summary();
  return result;
}

std::string json_text(const nlohmann::json& json) {
  return json.dump(2, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

void write_summary(const std::filesystem::path& folder, const nlohmann::json& summary) {
  write_atomically(folder / "summary.json", json_text(summary));
}

std::string outcome_text(const nlohmann::json& summary) {
  long points = 0;
  for (const auto& [name, count] : summary["counts"].items()) {
    if (name.ends_with("points")) points += count.get<long>();
  }
  return fmt::format(
      "{}: {} at t = {:g} s; {} points, {} windows, {:.2f} s, {:.0f} MB\n",
      summary["scene"]["path"].get<std::string>(), summary["outcome"].get<std::string>(),
      summary["time"]["value"].get<double>(), points, summary["counts"]["windows"].get<long>(),
      summary["wall_time"].get<double>(), summary["peak_memory"].get<double>() / 1e6);
}

std::string work_text(const nlohmann::json& summary) {
  std::string text;
  for (const auto& module : summary["modules"]) {
    text += fmt::format("  {:<10} {:<14} {:6d} advances {:8.3f} s\n",
                        module["name"].get<std::string>(), module["type"].get<std::string>(),
                        module["advances"].get<long>(), module["wall_time"].get<double>());
  }
  const auto& ledger = summary["ledger"];
  if (ledger.contains("mass_error")) {
    text += fmt::format("  fluid mass kept to {:.1e}\n", ledger["mass_error"].get<double>());
  }
  if (ledger.contains("energy_error")) {
    text +=
        fmt::format("  energy balance closed to {:.1e}\n", ledger["energy_error"].get<double>());
  }
  return text;
}

}  // namespace perifrac
