#pragma once

#include <string>
#include <vector>

#include "app/study/results.hpp"

namespace perifrac {

/// What the study says: the cheapest variant for each accuracy, orders, crossings of cost, and what
/// did not end well or was left out.
std::vector<std::string> sentences(const Study& study, const StudyResults& results,
                                   const std::vector<std::string>& left_out);

/// `1.2e-3`.
std::string error_text(double error);

/// `12 s`, `0.034 s`.
std::string time_text(double seconds);

/// `0.34 m`; in the unit of the axis.
std::string number_text(double number, const std::string& unit);

}  // namespace perifrac
