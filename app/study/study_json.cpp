#include "app/study/study_json.hpp"

#include <algorithm>
#include <cmath>

#include <nlohmann/json.hpp>

#include "app/run/version.hpp"

namespace perifrac {

namespace {

using SortedJson = nlohmann::json;

SortedJson spread_json(const Spread& spread) {
  return {{"median", spread.median}, {"least", spread.least}, {"most", spread.most}};
}

template <class T>
SortedJson or_null(const std::optional<T>& value) {
  return value ? SortedJson(*value) : SortedJson();
}

SortedJson choice_json(const Choice& choice) {
  SortedJson result = SortedJson::object();
  for (const auto& [axis, value] : choice) result[axis] = value;
  return result;
}

SortedJson axes_json(const Study& study) {
  SortedJson axes = SortedJson::array();
  for (const StudyAxis& axis : study.axes) {
    SortedJson labels = SortedJson::array(), numbers = SortedJson::array();
    for (const AxisValue& value : axis.values) {
      labels.push_back(value.label);
      numbers.push_back(std::isfinite(value.number) ? SortedJson(value.number) : SortedJson());
    }
    axes.push_back({{"name", axis.name},
                    {"unit", axis.unit},
                    {"problem", axis.problem},
                    {"numeric", axis.is_numeric()},
                    {"labels", labels},
                    {"numbers", numbers}});
  }
  return axes;
}

SortedJson error_json(const ErrorMeasure& error) {
  SortedJson result = {{"against", error.against},
                       {"norm", error.largest ? "largest" : "rms"},
                       {"from", error.from},
                       {"to", std::isfinite(error.to) ? SortedJson(error.to) : SortedJson()}};
  if (!error.quantity.empty()) result["quantity"] = error.quantity;
  if (!error.columns.empty()) result["columns"] = error.columns;
  return result;
}

SortedJson point_json(const Study& study, const StudyPoint& point) {
  Choice choice;
  for (std::size_t a = 0; a < point.variant->choice.size(); ++a) {
    const StudyAxis& axis = study.axes[a];
    choice.emplace_back(axis.name, axis.values[point.variant->choice[a]].label);
  }
  return {{"name", point.variant->name},
          {"choice", choice_json(choice)},
          {"scene", point.variant->scene},
          {"set", assignments(*point.variant)},
          {"threads", point.variant->threads},
          {"status", word(point.record->status)},
          {"message", point.record->message},
          {"error", or_null(point.error.error)},
          {"why_no_error", point.error.why},
          {"order", or_null(point.order)},
          {"cost", spread_json(point.cost)},
          {"wall_time", spread_json(point.wall)},
          {"cpu_time", point.cpu_time},
          {"output_time", point.output_time},
          {"peak_memory", point.peak_memory},
          {"runs", point.record->runs.size()},
          {"counts", point.run.value("counts", SortedJson::object())},
          {"modules", point.run.value("modules", SortedJson::array())}};
}

/// What the runs say they ran on, each once: a launcher may spread them.
SortedJson distinct(const StudyResults& results, const char* key) {
  SortedJson found = SortedJson::array();
  for (const StudyPoint& point : results.points) {
    if (!point.run.contains(key)) continue;
    if (std::ranges::find(found, point.run[key]) == found.end()) found.push_back(point.run[key]);
  }
  return found;
}

SortedJson ranking_json(const StudyResults& results, const Ranking& ranking) {
  const auto name = [&](std::size_t i) { return results.points[i].variant->name; };
  SortedJson front = SortedJson::array(), cheapest = SortedJson::array();
  for (const std::size_t i : ranking.front) front.push_back(name(i));
  for (const CheapestFor& entry : ranking.cheapest) {
    SortedJson reaching = SortedJson::array(), by_value = SortedJson::array();
    for (const std::size_t i : entry.reaching) reaching.push_back(name(i));
    for (const auto& [label, point] : entry.by_value) {
      by_value.push_back(
          {{"value", label}, {"variant", point ? SortedJson(name(*point)) : SortedJson()}});
    }
    cheapest.push_back(
        {{"accuracy", entry.accuracy}, {"reaching", reaching}, {"by_value", by_value}});
  }
  return {{"problem", choice_json(ranking.problem)}, {"front", front}, {"cheapest", cheapest}};
}

SortedJson orders_json(const StudyResults& results) {
  SortedJson orders = SortedJson::array();
  for (const ObservedOrder& order : results.orders) {
    SortedJson variants = SortedJson::array();
    for (const std::size_t i : order.points) variants.push_back(results.points[i].variant->name);
    orders.push_back({{"axis", order.axis},
                      {"others", choice_json(order.others)},
                      {"variants", variants},
                      {"numbers", order.numbers},
                      {"error", or_null(order.error)},
                      {"cost", or_null(order.cost)}});
  }
  return orders;
}

SortedJson crossings_json(const StudyResults& results) {
  SortedJson crossings = SortedJson::array();
  for (const CostCrossing& crossing : results.crossings) {
    crossings.push_back({{"axis", crossing.axis},
                         {"compared", crossing.compared},
                         {"below", crossing.values.first},
                         {"above", crossing.values.second},
                         {"others", choice_json(crossing.others)},
                         {"places", crossing.places}});
  }
  return crossings;
}

}  // namespace

SortedJson study_json(const Study& study, const StudyResults& results, const StudyOptions& options,
                      const std::vector<std::string>& left_out,
                      const std::vector<std::string>& sentences) {
  SortedJson variants = SortedJson::array(), rankings = SortedJson::array();
  for (const StudyPoint& point : results.points) variants.push_back(point_json(study, point));
  for (const Ranking& ranking : results.rankings) {
    rankings.push_back(ranking_json(results, ranking));
  }
  return {{"title", study.title},
          {"study", study.file},
          {"scene", study.scene},
          {"version", version},
          {"machines", distinct(results, "machine")},
          {"builds", distinct(results, "build")},
          {"jobs", options.jobs},
          {"launcher", options.launcher},
          {"repetitions", study.repetitions},
          {"axes", axes_json(study)},
          {"compare", study.compared},
          {"error", error_json(study.error)},
          {"cost", {{"of", study.cost_of}, {"time", study.cpu_cost ? "cpu" : "wall"}}},
          {"accuracies", study.accuracies},
          {"variants", variants},
          {"left_out", left_out},
          {"rankings", rankings},
          {"orders", orders_json(results)},
          {"crossings", crossings_json(results)},
          {"sentences", sentences}};
}

}  // namespace perifrac
