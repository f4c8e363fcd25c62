#pragma once

#include <limits>
#include <map>
#include <string>
#include <vector>

#include "app/study/overrides.hpp"
#include "core/config/section.hpp"

namespace perifrac {

/// One value of an axis.
struct AxisValue {
  std::string label;
  double number;  ///< in SI; NaN: it is none
  Overrides overrides;
};

struct StudyAxis {
  std::string name;
  std::string unit;  ///< of the numbers; empty where they have none
  bool problem;      ///< no choice but another problem
  std::vector<AxisValue> values;

  bool is_numeric() const;
};

/// Names of values by axis: a combination that is left out.
using AxisValues = std::map<std::string, std::vector<std::string>>;

struct ErrorMeasure {
  std::string against;
  std::string quantity{};
  std::vector<std::string> columns{};
  Overrides finer{};
  std::string axis{};
  bool largest = true;  ///< else the root mean square
  double from = 0.0;
  double to = std::numeric_limits<double>::infinity();
};

/// A study file as read.
struct Study {
  std::string file;
  std::string title;
  std::string scene;
  Overrides common;
  std::vector<StudyAxis> axes;
  std::vector<AxisValues> skipped;
  ErrorMeasure error;
  std::string cost_of;
  bool cpu_cost;         ///< CPU time is the cost, else wall time
  std::string compared;  ///< name of an axis
  std::vector<double> accuracies;
  int repetitions;
  double repeat_up_to;
  double budget_each = std::numeric_limits<double>::infinity();
  double budget_total = std::numeric_limits<double>::infinity();
  Section section;  ///< for messages

  const StudyAxis& axis(const std::string& name) const;
};

/// Throws InputError: `file:line:column: problem; what is expected; suggestion`.
Study read_study(const std::string& file);

}  // namespace perifrac
