#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "app/study/results.hpp"

namespace perifrac {

/// What study.json holds, which the drawing reads: app/study/README.md says what that is.
nlohmann::json study_json(const Study& study, const StudyResults& results,
                          const StudyOptions& options, const std::vector<std::string>& left_out,
                          const std::vector<std::string>& sentences);

}  // namespace perifrac
