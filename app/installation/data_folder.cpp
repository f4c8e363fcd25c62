#include "app/installation/data_folder.hpp"

#include <cstdlib>
#include <optional>

namespace perifrac {

namespace {

namespace fs = std::filesystem;

/// PREFIX/share/perifrac of PREFIX/bin/perifrac or PREFIX/libexec/perifrac/SET/perifrac.
std::optional<fs::path> installed_folder() {
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path sets = folder.parent_path();
  fs::path prefix;
  if (folder.filename() == "bin") prefix = folder.parent_path();
  if (sets.filename() == "perifrac" && sets.parent_path().filename() == "libexec") {
    prefix = sets.parent_path().parent_path();
  }
  if (error || prefix.empty()) return {};
  const fs::path share = prefix / "share" / "perifrac";
  if (!fs::is_directory(share / "configs", error)) return {};
  return share;
}

const std::optional<fs::path>& installed() {
  static const std::optional<fs::path> folder = installed_folder();
  return folder;
}

}  // namespace

const fs::path& data_folder() {
  static const fs::path folder = installed().value_or(PERIFRAC_SOURCE_DIR);
  return folder;
}

void name_own_unit_database() {
  const fs::path file = data_folder() / "udunits" / "udunits2.xml";
  std::error_code missing;
  constexpr int keep_what_is_said = 0;
  if (fs::exists(file, missing)) ::setenv("UDUNITS2_XML_PATH", file.c_str(), keep_what_is_said);
}

fs::path program_file() {
  if (!is_installed()) return fs::read_symlink("/proc/self/exe");
  return data_folder().parent_path().parent_path() / "bin" / "perifrac";
}

bool is_installed() { return installed().has_value(); }

}  // namespace perifrac
