#include "app/study/measures.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/study/orders.hpp"
#include "core/base/names.hpp"

namespace perifrac {

namespace {

/// The largest, or the root of the mean square.
class Norm {
 public:
  explicit Norm(bool largest) : largest_(largest) {}

  void add(double value) {
    most_ = std::max(most_, std::abs(value));
    squares_ += value * value;
    ++count_;
  }
  Measured result(const std::string& why_none) const {
    if (count_ == 0) return {{}, why_none};
    const double value = largest_ ? most_ : std::sqrt(squares_ / count_);
    if (!std::isfinite(squares_)) return {{}, "the error is not finite"};
    return {value, ""};
  }

 private:
  bool largest_;
  double most_ = 0.0;
  double squares_ = 0.0;
  int count_ = 0;
};

constexpr const char* no_time = "nothing lies between the times compared";

/// Rows of `fine` between the times compared that every table reaches.
std::vector<double> common_times(const std::vector<const HistoryTable*>& tables,
                                 const HistoryTable& fine, const ErrorMeasure& measure) {
  std::vector<double> times;
  for (const double time : fine.times()) {
    const bool in_all = std::ranges::all_of(tables, [&](const HistoryTable* table) {
      return !table->times().empty() && time <= table->times().back() * (1.0 + 1e-12);
    });
    if (time >= measure.from && time <= measure.to && in_all) times.push_back(time);
  }
  return times;
}

/// Sums a distance over the columns, each over the largest value of the finest.
Measured norm_of(const HistoryTable& fine, const std::vector<double>& times,
                 const ErrorMeasure& measure,
                 const std::function<double(const std::string& column, double time)>& difference) {
  Norm norm(measure.largest);
  for (const std::string& column : measure.columns) {
    if (!fine.has(column)) {
      return {{},
              fmt::format("no column {} in history.csv; {}", in_quotes(column),
                          expected_one_of(fine.names(), column))};
    }
    double scale = 0.0;
    for (const double time : times) scale = std::max(scale, std::abs(fine.at(column, time)));
    if (scale == 0.0) scale = 1.0;
    for (const double time : times) norm.add(difference(column, time) / scale);
  }
  return norm.result(no_time);
}

bool has_all(const HistoryTable& table, const ErrorMeasure& measure) {
  return std::ranges::all_of(measure.columns, [&](const auto& name) { return table.has(name); });
}

Measured table_error(const nlohmann::json& table, const ErrorMeasure& measure) {
  Norm norm(measure.largest);
  for (const auto& row : table) {
    const double time = row["time"];
    const auto value = row.find(measure.quantity);
    if (value == row.end() || value->is_null() || time < measure.from * (1.0 - 1e-12) ||
        time > measure.to * (1.0 + 1e-12)) {
      continue;
    }
    norm.add(*value);
  }
  return norm.result(no_time);
}

}  // namespace

std::vector<std::string> reference_quantities(const nlohmann::json& summary) {
  std::vector<std::string> names;
  if (!summary.contains("reference")) return names;
  const nlohmann::json& reference = summary["reference"];
  for (const auto& row : reference["table"]) {
    for (const auto& [name, value] : row.items()) {
      const bool known = std::ranges::count(names, name) > 0;
      if (!known && name != "time" && name != "dimensionless_time") names.push_back(name);
    }
  }
  for (const auto& quantity : reference.value("quantities", nlohmann::json::array())) {
    names.push_back(quantity["name"]);
  }
  return names;
}

Measured reference_error(const nlohmann::json& summary, const ErrorMeasure& measure) {
  if (!summary.contains("reference")) return {{}, "its scene has no reference"};
  for (const auto& quantity : summary["reference"].value("quantities", nlohmann::json::array())) {
    if (quantity["name"] == measure.quantity) return {quantity["max_error"].get<double>(), ""};
  }
  return table_error(summary["reference"]["table"], measure);
}

Measured distance(const HistoryTable& coarse, const HistoryTable& fine,
                  const ErrorMeasure& measure) {
  if (!has_all(coarse, measure)) return norm_of(coarse, {}, measure, {});  // says which is missing
  const std::vector<double> times = common_times({&coarse}, fine, measure);
  return norm_of(fine, times, measure, [&](const std::string& column, double time) {
    return coarse.at(column, time) - fine.at(column, time);
  });
}

Extrapolated richardson(const std::vector<HistoryTable>& histories,
                        const std::vector<double>& numbers, const ErrorMeasure& measure) {
  const std::size_t n = histories.size();
  Extrapolated result{std::vector<Measured>(n, {{}, "three runs along the axis are needed"}), {}};
  if (n < 3) return result;
  std::vector<const HistoryTable*> tables;
  for (const HistoryTable& table : histories) tables.push_back(&table);
  const HistoryTable& finest = histories.back();
  const std::vector<double> times = common_times(tables, finest, measure);
  const auto between = [&](std::size_t i, std::size_t j) {
    return norm_of(finest, times, measure, [&](const std::string& column, double time) {
      return histories[i].at(column, time) - histories[j].at(column, time);
    });
  };
  const Measured coarse = between(n - 3, n - 2), fine = between(n - 2, n - 1);
  const double ratio = numbers[n - 2] / numbers[n - 1];
  const double other = numbers[n - 3] / numbers[n - 2];
  if (!coarse.error || !fine.error) {
    result.errors.assign(n, coarse.error ? fine : coarse);
    return result;
  }
  const auto limit = std::abs(ratio / other - 1.0) < 1e-6
                         ? extrapolate(*coarse.error, *fine.error, std::max(ratio, 1.0 / ratio))
                         : std::nullopt;
  if (!limit) {
    result.errors.assign(n, {{}, "the three finest do not tend to a limit in equal steps"});
    return result;
  }
  result.order = limit->order;
  for (std::size_t i = 0; i < n; ++i) {
    result.errors[i] = norm_of(finest, times, measure, [&](const std::string& column, double time) {
      const double last = finest.at(column, time);
      const double step = last - histories[n - 2].at(column, time);
      return histories[i].at(column, time) - (last + limit->share * step);
    });
  }
  return result;
}

}  // namespace perifrac
