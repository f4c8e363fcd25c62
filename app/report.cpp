#include "app/report.hpp"

#include "app/drawing.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  return draw(PERIFRAC_REPORT_SCRIPT, folder, quiet);
}

}  // namespace perifrac
