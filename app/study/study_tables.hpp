#pragma once

#include <string>

#include "app/study/results.hpp"

namespace perifrac {

/// A row a variant, all that was measured of it; units in the header.
std::string csv_table(const Study& study, const StudyResults& results);

/// What a paper shows of it: values of the axes, error, cost, steps and memory.
std::string markdown_table(const Study& study, const StudyResults& results);
std::string latex_table(const Study& study, const StudyResults& results);

}  // namespace perifrac
