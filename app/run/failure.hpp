#pragma once

#include <exception>
#include <optional>
#include <string>

namespace perifrac {

/// Why a run failed, for summary.json and the page: what its log says last.
struct Failure {
  std::string error;  ///< the whole line
  std::string field{}, place{};
  std::optional<double> time{};  ///< [s]
  std::string advice{};          ///< what to change; empty: nothing is known to help
};

/// Field, place, time and advice are those of a NumericalError; another one has none.
Failure failure_of(const std::exception& error);

/// In one line: the error, then what to change.
std::string describe(const Failure& failure);

}  // namespace perifrac
