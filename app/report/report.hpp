#pragma once

#include <filesystem>

namespace perifrac {

/// Makes DIR/report.png and DIR/report.html by the report script, which prints their paths unless
/// `quiet`; returns its exit code. A missing Python is a warning: the results are there anyway.
int make_report(const std::filesystem::path& folder, bool quiet);

}  // namespace perifrac
