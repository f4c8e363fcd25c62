#include "app/report/report.hpp"

#include "app/installation/data_folder.hpp"
#include "app/report/drawing.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  return make_report(std::vector<std::string>{folder.string()}, quiet);
}

int make_report(const std::vector<std::string>& folders, bool quiet) {
  return draw(data_folder() / "app/report/report.py", folders, quiet);
}

}  // namespace perifrac
