#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace perifrac::test {

/// What a run of a scene came to.
struct SceneRun {
  int exit_code;
  nlohmann::json summary;
  std::filesystem::path folder;

  /// The largest error of this name among the outputs at dimensionless times `from` to `to`, both
  /// included; fails the test where there is none.
  double largest(const std::string& error, double from, double to) const;
  /// The error of the number of this name that a history comes to; fails the test where there is
  /// none.
  double figure(const std::string& name) const;
  /// The largest |computed - exact| of the history of this name.
  double history(const std::string& name) const;
  /// A column of history.csv, as its header names it; fails the test where there is none.
  std::vector<double> column(const std::string& name) const;
};

/// Runs configs/`name`.yaml, which prints its errors, with `--set` overrides as `perifrac run`
/// does.
SceneRun run_config(const std::string& name, const std::vector<std::string>& overrides = {});

}  // namespace perifrac::test
