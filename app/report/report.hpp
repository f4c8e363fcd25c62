#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace perifrac {

/// Makes DIR/report.png and DIR/report.html by the report script, which prints their paths unless
/// `quiet`; returns its exit code. A missing Python is a warning: the results are there anyway.
int make_report(const std::filesystem::path& folder, bool quiet);

/// The same of one folder; of two a page that shows both runs side by side, in the first one.
int make_report(const std::vector<std::string>& folders, bool quiet);

}  // namespace perifrac
