#include "app/report/report.hpp"

#include "app/report/drawing.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  return draw(PERIFRAC_REPORT_SCRIPT, folder, quiet);
}

}  // namespace perifrac
