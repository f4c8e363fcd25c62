#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "app/references/reference.hpp"
#include "app/run/failure.hpp"
#include "app/simulation/simulation.hpp"
#include "core/config/section.hpp"

namespace perifrac {

enum class RunOutcome { done, failed, stopped };

/// How a run ended.
struct RunEnd {
  RunOutcome outcome = RunOutcome::done;
  std::optional<Failure> failure{};  ///< of one that failed
};

/// Wall times [s] of a run.
struct WallTime {
  double whole;
  double output;  ///< of it, in history, frames, checkpoints and the comparison with a reference
};

/// What summary.json holds; its keys are described in app/report/README.md.
nlohmann::json summarize(const Section& scene, const std::string& scene_file,
                         const std::string& scene_text, Simulation& simulation,
                         const Reference* reference, const RunEnd& end, const WallTime& wall);

/// JSON as text. Bytes of a scene that are not UTF-8 are replaced: they must not cost the results.
std::string json_text(const nlohmann::json& json);

/// Writes DIR/summary.json atomically. Throws OutputError.
void write_summary(const std::filesystem::path& folder, const nlohmann::json& summary);

/// The first line at the end of a run: how it ended, and what it took.
std::string outcome_text(const nlohmann::json& summary);

/// What modules did, and how well mass and energy were kept.
std::string work_text(const nlohmann::json& summary);

/// `<physics>: <type>` of everything that the scene calls for, and no more.
std::vector<std::string> effects(const Section& scene);

/// Points and bonds of the body, mirrored faces included, and `<set>_points` of every other set
/// with a field.
nlohmann::json counts(const Simulation& simulation);

}  // namespace perifrac
