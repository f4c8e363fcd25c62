#include "app/report/report.hpp"

#include "app/report/drawing.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  return draw(PERIFRAC_REPORT_SCRIPT, {folder.string()}, quiet);
}

int make_report(const std::vector<std::string>& folders, bool quiet) {
  return draw(PERIFRAC_REPORT_SCRIPT, folders, quiet);
}

}  // namespace perifrac
