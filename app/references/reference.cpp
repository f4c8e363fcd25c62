#include "app/references/reference.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace perifrac {

void Reference::record_history(double t) {
  history_time_.push_back(t);
  for (auto& [history, values] : histories_) values.push_back(history.computed());
}

void Reference::record_output(double t) {
  output_time_.push_back(t);
  for (auto& [error, values] : errors_) values.push_back(error.value(t));
  for (auto& [profile, values] : profiles_) {
    for (std::size_t n = 0; n < profile.x.size(); ++n) values.push_back(profile.computed(n));
  }
}

void Reference::visit_state(StateVisitor& visitor) {
  visitor.visit("history_time", history_time_);
  for (auto& [history, values] : histories_) visitor.visit("history " + history.name, values);
  visitor.visit("output_time", output_time_);
  for (auto& [error, values] : errors_) visitor.visit(error.name, values);
  for (auto& [profile, values] : profiles_) visitor.visit("profile " + profile.name, values);
}

std::optional<double> Reference::computed(const Figure& figure) const {
  return figure.computed(history_time_, histories_.at(figure.history).values);
}

nlohmann::json Reference::summary() const {
  nlohmann::json result = {{"type", type_}, {"title", title_}, {"table", table_summary()}};
  for (const Figure& figure : figures_) {
    const auto value = computed(figure);
    if (!value) continue;
    result["quantities"].push_back({{"name", figure.name},
                                    {"unit", ""},
                                    {"max_error", std::abs(*value - figure.exact) / figure.scale},
                                    {"computed", {{"value", *value}, {"unit", figure.unit}}},
                                    {"exact", {{"value", figure.exact}, {"unit", figure.unit}}}});
  }
  for (const auto& history : histories_) result["histories"].push_back(history_summary(history));
  for (const Rate& rate : rates_) result["histories"].push_back(rate_summary(rate));
  for (const auto& profile : profiles_) result["profiles"].push_back(profile_summary(profile));
  return result;
}

nlohmann::json Reference::table_summary() const {
  auto rows = nlohmann::json::array();
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    auto& row = rows.emplace_back(nlohmann::json{{"time", output_time_[n]}});
    if (time_scale_ > 0.0) row["dimensionless_time"] = output_time_[n] / time_scale_;
    for (const auto& [error, values] : errors_) row[error.name] = values[n];
  }
  return rows;
}

nlohmann::json Reference::history_summary(const Recorded<History>& history) const {
  std::vector<double> exact;
  for (const double t : history_time_) exact.push_back(history.compared.exact(t));
  return {{"name", history.compared.name},
          {"unit", history.compared.unit},
          {"time", history_time_},
          {"computed", history.values},
          {"exact", exact}};
}

nlohmann::json Reference::rate_summary(const Rate& rate) const {
  const auto& [history, values] = histories_.at(rate.history);
  std::vector<double> times, computed, exact;
  for (std::size_t n = 1; n < history_time_.size(); ++n) {
    const double from = history_time_[n - 1], to = history_time_[n];
    times.push_back(0.5 * (from + to));
    computed.push_back((values[n] - values[n - 1]) / (to - from));
    exact.push_back((history.exact(to) - history.exact(from)) / (to - from));
  }
  return {{"name", rate.name},
          {"unit", rate.unit},
          {"time", times},
          {"computed", computed},
          {"exact", exact}};
}

nlohmann::json Reference::profile_summary(const Recorded<Profile>& recorded) const {
  const auto& [profile, values] = recorded;
  nlohmann::json result = {{"name", profile.name},
                           {"unit", profile.unit},
                           {"x_name", profile.x_name},
                           {"x_unit", "m"},
                           {"times", output_time_}};
  for (const char* const key : {"x", "computed", "exact"}) result[key] = nlohmann::json::array();
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    const auto begin = values.begin() + n * profile.x.size();
    std::vector<double> exact;
    for (const double x : profile.x) exact.push_back(profile.exact(x, output_time_[n]));
    result["x"].push_back(profile.x);
    result["computed"].push_back(std::vector<double>(begin, begin + profile.x.size()));
    result["exact"].push_back(exact);
  }
  return result;
}

std::string Reference::table() const {
  const auto words = [](std::string name) {
    std::ranges::replace(name, '_', ' ');
    return name;
  };
  std::string text = fmt::format("{:>12}", "time [s]");
  if (time_scale_ > 0.0) text += fmt::format("  {:>8}", "T");
  for (const auto& [error, values] : errors_) text += fmt::format("  {:>20}", words(error.name));
  text += '\n';
  for (std::size_t n = 0; n < output_time_.size(); ++n) {
    text += fmt::format("{:12.5g}", output_time_[n]);
    if (time_scale_ > 0.0) text += fmt::format("  {:8.4f}", output_time_[n] / time_scale_);
    for (const auto& [error, values] : errors_) text += fmt::format("  {:20.2e}", values[n]);
    text += '\n';
  }
  for (const Figure& figure : figures_) {
    const auto value = computed(figure);
    if (!value) continue;
    text += fmt::format("{}: {:.6g}, exact {:.6g} {}; error {:.2e}\n", figure.name, *value,
                        figure.exact, figure.unit, std::abs(*value - figure.exact) / figure.scale);
  }
  return text;
}

}  // namespace perifrac
