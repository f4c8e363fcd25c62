#include "tests/verification/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/run/run.hpp"

namespace perifrac::test {

SceneRun run_config(const std::string& name, const std::vector<std::string>& overrides) {
  RunRequest request;
  request.scene = PERIFRAC_SOURCE_DIR "/configs/" + name + ".yaml";
  request.overrides = overrides;
  request.output = fmt::format("{}{}_{}", testing::TempDir(), name, getpid());
  request.report = false;
  const int exit_code = run_scene(request);
  std::ifstream file(request.output + "/summary.json");
  return {exit_code, nlohmann::json::parse(file), request.output};
}

double SceneRun::largest(const std::string& error, double from, double to) const {
  double largest = -1.0;
  for (const auto& row : summary["reference"]["table"]) {
    const double time = row["dimensionless_time"];
    if (time > 0.999 * from && time < 1.001 * to) {
      largest = std::max<double>(largest, row[error]);
    }
  }
  EXPECT_GE(largest, 0.0) << "no output between " << from << " and " << to;
  return largest;
}

double SceneRun::figure(const std::string& name) const {
  for (const auto& quantity : summary["reference"]["quantities"]) {
    if (quantity["name"] == name) return quantity["max_error"];
  }
  ADD_FAILURE() << "no " << name;
  return INFINITY;
}

double SceneRun::history(const std::string& name) const {
  double largest = -1.0;
  for (const auto& history : summary["reference"]["histories"]) {
    if (history["name"] != name) continue;
    for (std::size_t n = 0; n < history["time"].size(); ++n) {
      const double computed = history["computed"][n], exact = history["exact"][n];
      largest = std::max(largest, std::abs(computed - exact));
    }
  }
  EXPECT_GE(largest, 0.0) << "no " << name;
  return largest;
}

std::vector<double> SceneRun::column(const std::string& name) const {
  std::ifstream file(folder / "history.csv");
  std::string line, cell;
  std::getline(file, line);
  std::stringstream header(line);
  std::vector<std::string> names;
  while (std::getline(header, cell, ',')) names.push_back(cell);
  const auto place = std::ranges::find(names, name) - names.begin();
  EXPECT_LT(place, std::ssize(names)) << "no " << name;
  std::vector<double> values;
  while (std::getline(file, line)) {
    std::stringstream row(line);
    for (auto k = place; k >= 0; --k) std::getline(row, cell, ',');
    values.push_back(std::stod(cell));
  }
  return values;
}

}  // namespace perifrac::test
