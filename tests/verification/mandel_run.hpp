#pragma once

#include <string>
#include <vector>

#include "app/simulation/simulation.hpp"

namespace perifrac::test {

/// What a run of configs/mandel.yaml came to.
struct MandelRun {
  struct Row {
    double dimensionless_time;
    double pressure_error;
    double plate_error;
  };
  std::vector<Row> rows;  ///< one an output
  double peak_error = 0.0;
  std::int64_t solid_solves = 0;
  std::int64_t most_passes = 0;  ///< in any window
  double mass_error = 0.0;
  double energy_error = 0.0;
  double seconds = 0.0;  ///< in advancing, set-up apart
  int exit_code = 0;
  std::vector<std::vector<double>> profile;  ///< pressure along x, one row an output

  double largest_pressure_error(double from_time, double to_time) const;
  double largest_plate_error() const;
};

/// Runs configs/<scene>.yaml with `--set` overrides as `perifrac run` does.
MandelRun run_mandel(const std::vector<std::string>& overrides,
                     const std::string& scene = "mandel");

/// The simulation that it makes, initialised.
Simulation make_mandel(const std::vector<std::string>& overrides);

}  // namespace perifrac::test
