#pragma once

#include <vector>

#include "app/study/measures.hpp"
#include "app/study/pareto.hpp"
#include "app/study/study_run.hpp"

namespace perifrac {

/// Of the runs that count.
struct Spread {
  double median = 0.0;
  double least = 0.0;
  double most = 0.0;
};

/// What a variant reached and took. Times are in [s], memory in [bytes].
struct StudyPoint {
  const Variant* variant;
  const VariantRecord* record;
  Measured error{};
  Spread cost{};  ///< of one that ended otherwise than well: its wall time until then
  Spread wall{};
  double cpu_time = 0.0;
  double output_time = 0.0;
  double peak_memory = 0.0;
  std::optional<double> order{};                  ///< by Richardson's extrapolation
  nlohmann::json run = nlohmann::json::object();  ///< the run whose cost is nearest to the median

  bool is_ranked() const { return error.error.has_value(); }
};

/// Errors and costs of all variants, the finer run among them. Throws InputError where the study
/// names a quantity or a column that the runs do not have.
std::vector<StudyPoint> evaluate(const Study& study, const std::vector<Variant>& variants,
                                 const std::vector<VariantRecord>& records,
                                 const StudyOptions& options);

/// Median, least and largest; all 0 of nothing.
Spread spread(std::vector<double> values);

}  // namespace perifrac
