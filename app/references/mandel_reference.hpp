#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/references/mandel_solution.hpp"
#include "app/simulation.hpp"
#include "core/config/section.hpp"
#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Holds a run of Mandel's problem against its analytic solution.
class MandelReference {
 public:
  /// Throws InputError where the scene is not Mandel's problem: a 2D box on rollers at left and
  /// bottom, a rigid plate at the top, drained at the right.
  MandelReference(const Section& scene, const Simulation& simulation);

  void record_window(double t);  ///< histories, after every window
  void record_output(double t);  ///< errors and profiles, with every frame

  void visit_state(StateVisitor& visitor);

  /// The `reference` part of summary.json.
  nlohmann::json summary() const;
  /// The errors as a table for the terminal.
  std::string table() const;

 private:
  /// Computed values at one place over time.
  struct History {
    Index point;
    std::vector<double> computed;
  };

  double peak_error() const;  ///< of the pressure in the middle over p0, windows apart
  bool peak_passed() const;
  nlohmann::json profile_summary() const;

  MandelSolution solution_;
  Field pressure_;
  Field plate_;
  const Points<2>* points_;
  std::vector<Index> row_;          ///< points of the lowest row, by x
  std::vector<History> histories_;  ///< in the middle, then at a/4, a/2, 3a/4
  std::vector<double> window_time_;
  std::vector<double> output_time_;
  std::vector<double> pressure_error_;  ///< largest |p - exact| / p0, one an output
  std::vector<double> plate_error_;     ///< |U - exact| / |exact|, one an output
  std::vector<double> profile_;         ///< pressures of the row, output by output
};

}  // namespace perifrac
