#pragma once

#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "core/state/state_visitor.hpp"

namespace perifrac {

/// Holds a run against an exact solution. A reference says what is compared; recording, restart,
/// table and summary are the same for all.
class Reference {
 public:
  using Computed = std::function<double()>;        ///< the value in the run, as it is now
  using OfTime = std::function<double(double t)>;  ///< t in [s]

  /// A value at one place over time, recorded with the rows of history.csv.
  struct History {
    std::string name;  ///< `QUANTITY at PLACE`
    std::string unit;
    Computed computed;
    OfTime exact;
  };
  /// The rate of a history, from one row to the next, of the exact values alike.
  struct Rate {
    std::string name;  ///< `QUANTITY at PLACE`
    std::string unit;
    std::size_t history;
  };
  /// An error over the whole body, recorded with every output.
  struct Error {
    std::string name;
    OfTime value;
  };
  /// Values at places along a line, recorded with every output.
  struct Profile {
    std::string name;  ///< `QUANTITY along PATH`
    std::string unit;
    std::string x_name;
    std::vector<double> x;  ///< [m]
    std::function<double(std::size_t place)> computed;
    std::function<double(double x, double t)> exact;
  };
  /// A number that a whole history comes to, such as its peak; nothing before it is known.
  struct Figure {
    std::string name;
    std::string unit;
    double exact;
    double scale;  ///< the error is |computed - exact| / scale
    std::size_t history;
    std::function<std::optional<double>(std::span<const double> times,
                                        std::span<const double> values)>
        computed;
  };

  /// `time_scale` [s] makes time dimensionless; 0: nothing does.
  Reference(std::string type, std::string title, double time_scale)
      : type_(std::move(type)), title_(std::move(title)), time_scale_(time_scale) {}

  /// Returns its number, for rates and figures.
  std::size_t add(History history) {
    histories_.push_back({std::move(history), {}});
    return histories_.size() - 1;
  }
  void add(Rate rate) { rates_.push_back(std::move(rate)); }
  void add(Error error) { errors_.push_back({std::move(error), {}}); }
  void add(Profile profile) { profiles_.push_back({std::move(profile), {}}); }
  void add(Figure figure) { figures_.push_back(std::move(figure)); }

  void record_history(double t);
  void record_output(double t);
  void visit_state(StateVisitor& visitor);

  /// The `reference` part of summary.json, described in app/report/README.md.
  nlohmann::json summary() const;
  /// The errors as a table for the terminal.
  std::string table() const;

 private:
  /// What is compared, and what was recorded of it so far.
  template <class T>
  struct Recorded {
    T compared;
    std::vector<double> values;
  };
  std::optional<double> computed(const Figure& figure) const;
  nlohmann::json table_summary() const;
  nlohmann::json history_summary(const Recorded<History>& history) const;
  nlohmann::json rate_summary(const Rate& rate) const;
  nlohmann::json profile_summary(const Recorded<Profile>& profile) const;

  std::string type_;
  std::string title_;
  double time_scale_;
  std::vector<Recorded<History>> histories_;
  std::vector<Rate> rates_;
  std::vector<Recorded<Error>> errors_;
  std::vector<Recorded<Profile>> profiles_;  ///< values place by place, output by output
  std::vector<Figure> figures_;
  std::vector<double> history_time_;
  std::vector<double> output_time_;
};

}  // namespace perifrac
