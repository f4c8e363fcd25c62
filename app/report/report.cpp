#include "app/report/report.hpp"

#include "app/installation/data_folder.hpp"
#include "app/report/drawing.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  return draw(data_folder() / "app/report/report.py", folder, quiet);
}

}  // namespace perifrac
