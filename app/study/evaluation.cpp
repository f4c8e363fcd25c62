#include "app/study/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/base/names.hpp"

namespace perifrac {

namespace {

nlohmann::json summary_of(const StudyOptions& options, const Variant& variant) {
  std::ifstream file(folder_of(options, variant) / "summary.json");
  return nlohmann::json::parse(file, nullptr, false);
}

HistoryTable history_of(const StudyOptions& options, const Variant& variant) {
  return HistoryTable(folder_of(options, variant) / "history.csv");
}

/// Time [s] that counts as the cost of a run; NaN where the module is not in it.
double cost_of(const nlohmann::json& run, const Study& study) {
  const char* const time = study.cpu_cost ? "cpu_time" : "wall_time";
  if (study.cost_of == "run") {
    const double output = study.cpu_cost ? 0.0 : run["output_time"].get<double>();
    return run[time].get<double>() - output;
  }
  for (const auto& module : run["modules"]) {
    if (module["name"] == study.cost_of) return module[time];
  }
  return std::nan("");
}

/// The first of several runs warmed up.
std::vector<nlohmann::json> counted(const std::vector<nlohmann::json>& runs) {
  return {runs.size() > 1 ? runs.begin() + 1 : runs.begin(), runs.end()};
}

Spread spread_of(const std::vector<nlohmann::json>& runs,
                 const std::function<double(const nlohmann::json&)>& value) {
  std::vector<double> values;
  for (const auto& run : runs) values.push_back(value(run));
  return spread(values);
}

StudyPoint take(const Study& study, const Variant& variant, const VariantRecord& record) {
  StudyPoint point{.variant = &variant, .record = &record};
  if (record.runs.empty()) return point;
  const bool done = record.status == VariantStatus::done;
  const auto runs = done ? counted(record.runs) : std::vector{record.runs.back()};
  const auto of = [&](const char* key) {
    return spread_of(runs, [&](const nlohmann::json& run) { return run.value(key, 0.0); });
  };
  const auto cost = [&](const nlohmann::json& run) {
    return done ? cost_of(run, study) : run[study.cpu_cost ? "cpu_time" : "elapsed"].get<double>();
  };
  point.cost = spread_of(runs, cost);
  point.wall = done ? of("wall_time") : of("elapsed");
  point.cpu_time = of("cpu_time").median;
  point.output_time = of("output_time").median;
  point.peak_memory = of("peak_memory").median;
  point.run = *std::ranges::min_element(
      runs, {}, [&](const nlohmann::json& run) { return std::abs(cost(run) - point.cost.median); });
  if (!done) point.error.why = word(record.status);
  return point;
}

void against_reference(const Study& study, std::vector<StudyPoint>& points,
                       const StudyOptions& options) {
  for (StudyPoint& point : points) {
    if (point.record->status != VariantStatus::done) continue;
    const nlohmann::json summary = summary_of(options, *point.variant);
    const auto known = reference_quantities(summary);
    if (!known.empty() && std::ranges::count(known, study.error.quantity) == 0) {
      study.section.fail_unknown("error.quantity", study.error.quantity, known);
    }
    point.error = reference_error(summary, study.error);
  }
}

void refuse_unknown_columns(const Study& study, const HistoryTable& history) {
  for (const std::string& column : study.error.columns) {
    if (!history.has(column)) study.section.fail_unknown("error.columns", column, history.names());
  }
}

void against_finer(const Study& study, std::vector<StudyPoint>& points,
                   const StudyOptions& options) {
  const StudyPoint& finer = points.back();
  if (finer.record->status != VariantStatus::done) {
    for (StudyPoint& point : points) {
      if (point.error.why.empty())
        point.error.why = "the finer run is " + word(finer.record->status);
    }
    return;
  }
  const HistoryTable fine = history_of(options, *finer.variant);
  refuse_unknown_columns(study, fine);
  for (StudyPoint& point : points) {
    if (point.record->status != VariantStatus::done || &point == &finer) continue;
    point.error = distance(history_of(options, *point.variant), fine, study.error);
  }
  points.back().error.why = "errors are against it";
}

void by_richardson(const Study& study, std::vector<StudyPoint>& points,
                   const StudyOptions& options) {
  const auto along = static_cast<std::size_t>(
      std::ranges::find(study.axes, study.error.axis, &StudyAxis::name) - study.axes.begin());
  std::map<std::vector<std::size_t>, std::vector<StudyPoint*>> lines;
  for (StudyPoint& point : points) {
    std::vector<std::size_t> others = point.variant->choice;
    others[along] = 0;
    if (point.record->status == VariantStatus::done) lines[others].push_back(&point);
  }
  for (auto& [others, line] : lines) {
    std::vector<HistoryTable> histories;
    std::vector<double> numbers;
    for (const StudyPoint* point : line) {
      histories.push_back(history_of(options, *point->variant));
      refuse_unknown_columns(study, histories.back());
      numbers.push_back(study.axes[along].values[point->variant->choice[along]].number);
    }
    const Extrapolated found = richardson(histories, numbers, study.error);
    for (std::size_t i = 0; i < line.size(); ++i) {
      line[i]->error = found.errors[i];
      line[i]->order = found.order;
    }
  }
}

}  // namespace

Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

std::vector<StudyPoint> evaluate(const Study& study, const std::vector<Variant>& variants,
                                 const std::vector<VariantRecord>& records,
                                 const StudyOptions& options) {
  std::vector<StudyPoint> points;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    points.push_back(take(study, variants[i], records[i]));
  }
  if (study.error.against == "reference") against_reference(study, points, options);
  if (study.error.against == "finer") against_finer(study, points, options);
  if (study.error.against == "richardson") by_richardson(study, points, options);
  for (StudyPoint& point : points) {
    if (!point.error.error || std::isfinite(point.cost.median)) continue;
    point.error = {{}, fmt::format("it has no module {}", in_quotes(study.cost_of))};
    point.cost = point.wall;
  }
  return points;
}

}  // namespace perifrac
