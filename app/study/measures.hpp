#pragma once

#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/study/history_table.hpp"
#include "app/study/study_file.hpp"

namespace perifrac {

/// An error, or why there is none.
struct Measured {
  std::optional<double> error;
  std::string why{};
};

/// Names of the errors that a run's summary has.
std::vector<std::string> reference_quantities(const nlohmann::json& summary);

/// The error that a run itself found against its reference.
Measured reference_error(const nlohmann::json& summary, const ErrorMeasure& measure);

/// The distance of two histories over the largest values of `fine`, at the rows of `fine` that both
/// have.
Measured distance(const HistoryTable& coarse, const HistoryTable& fine,
                  const ErrorMeasure& measure);

/// Errors of histories along an axis, the finest last, against what the last three tend to.
/// `numbers` are the places on the axis. Gives the order too, where there is one.
struct Extrapolated {
  std::vector<Measured> errors;
  std::optional<double> order;
};
Extrapolated richardson(const std::vector<HistoryTable>& histories,
                        const std::vector<double>& numbers, const ErrorMeasure& measure);

}  // namespace perifrac
