#include "app/run/check_text.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace perifrac {

namespace {

using Words = std::vector<std::string>;

std::string spelt(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

void print_regime(const nlohmann::json& regime) {
  fmt::print("  regime: {}\n", regime["corner"].get<std::string>());
  for (const auto& [name, entry] : regime.items()) {
    if (entry.is_number()) fmt::print("    {:<24} {:>10.4g}\n", spelt(name), entry.get<double>());
    if (!entry.is_object()) continue;
    fmt::print("    {:<24} {:>10.4g} {}\n", spelt(name), entry["value"].get<double>(),
               entry["unit"].get<std::string>());
  }
}

void print_forecast(const nlohmann::json& forecast) {
  const int processes = forecast["processes"].get<int>();
  const std::string each =
      processes > 1 ? fmt::format(" in each of {} processes", processes) : std::string();
  fmt::print("  run time: {:.3g} s, {} windows, {:.0f} MB{}, without writing results; most in {}\n",
             forecast["seconds"].get<double>(), forecast["windows"].get<long>(),
             forecast["peak_memory"].get<double>() / 1e6, each,
             forecast["most_in"].get<std::string>());
  for (const auto& [part, seconds] : forecast["seconds_by_part"].items()) {
    fmt::print("    {:<24} {:>10.3g} s\n", part, seconds.get<double>());
  }
  const auto& trial = forecast["trial"];
  if (!trial["is_whole"].get<bool>()) {
    fmt::print("    from a trial to t = {:.3g} s, {:.1f} s long\n", trial["time"].get<double>(),
               trial["seconds"].get<double>());
  }
  if (forecast.contains("crack_length")) {
    fmt::print("    for a crack that gets {:.3g} m long\n",
               forecast["crack_length"]["value"].get<double>());
  }
  if (forecast.contains("crack_area")) {
    fmt::print("    for cracks of {:.3g} m^2 in the end\n",
               forecast["crack_area"]["value"].get<double>());
  }
  if (forecast.contains("failure")) {
    fmt::print("  warning: a run stops: {}\n", forecast["failure"].get<std::string>());
  }
}

/// How bonds are gone over, what is handed over, and every evolving array.
void print_arrays(const nlohmann::json& result) {
  for (const auto& link : result.value("links", nlohmann::json::array())) {
    fmt::print("  link {}\n", link.get<std::string>());
  }
  const auto loops = result.value("bond_loops", nlohmann::json::object());
  for (const auto& [name, path] : loops.items()) {
    fmt::print("  bonds of {}: {}\n", name, path.get<std::string>());
  }
  if (result.contains("instructions")) {
    fmt::print("  instructions: {}\n", result["instructions"].get<std::string>());
  }
  if (result.contains("family_bytes")) {
    fmt::print("  bonds take {} kB\n", result["family_bytes"].get<long>() / 1000);
  }
  for (const auto& array : result.value("arrays", nlohmann::json::array())) {
    fmt::print("  {:<48} {:>10} values {:>12} bytes\n", array["name"].get<std::string>(),
               array["count"].get<long>(), array["bytes"].get<long>());
  }
}

/// `3088 points, 59152 bonds, 14 crack points`: the body first.
std::string sizes(const nlohmann::json& counts) {
  Words parts;
  const auto append = [&](const std::string& name) {
    const long count = counts.value(name, 0L);
    if (count > 0) parts.push_back(fmt::format("{} {}", count, spelt(name)));
  };
  append("points");
  for (const auto& [name, count] : counts.items()) {
    if (name != "points") append(name);
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

void print_check(const nlohmann::json& result, bool arrays) {
  fmt::print("{}: {}\n", result["scene"].get<std::string>(),
             result.contains("links") ? "fine" : "its keys are fine; it was not built");
  if (const std::string title = result.value("title", ""); !title.empty()) {
    fmt::print("  {}\n", title);
  }
  fmt::print("  {}\n", fmt::join(result["effects"].get<Words>(), ", "));
  fmt::print("  {}\n", sizes(result["counts"]));
  for (const auto& line : result.value("read", Words())) fmt::print("  {}\n", line);
  if (result.contains("regime")) print_regime(result["regime"]);
  if (result.contains("forecast")) print_forecast(result["forecast"]);
  if (result.contains("memory") && !result.contains("forecast")) {
    fmt::print("  memory: about {:.0f} MB, and {:.0f} MB are free\n",
               1e-6 * result["memory"]["estimate"].get<double>(),
               1e-6 * result["memory"]["available"].get<double>());
  }
  if (arrays) print_arrays(result);
  for (const auto& warning : result["warnings"]) {
    fmt::print("  warning: {}\n", warning.get<std::string>());
  }
}

}  // namespace perifrac
