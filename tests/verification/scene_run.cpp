#include "tests/verification/scene_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <unistd.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "app/run.hpp"

namespace perifrac::test {

SceneRun run_config(const std::string& name, const std::vector<std::string>& overrides) {
  RunRequest request;
  request.scene = PERIFRAC_SOURCE_DIR "/configs/" + name + ".yaml";
  request.overrides = overrides;
  request.output = fmt::format("{}{}_{}", testing::TempDir(), name, getpid());
  request.report = false;
  const int exit_code = run_scene(request);
  std::ifstream file(request.output + "/summary.json");
  return {exit_code, nlohmann::json::parse(file)};
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

}  // namespace perifrac::test
