#include "app/installation/data_folder.hpp"

#include <cstdlib>
#include <dlfcn.h>
#include <optional>

namespace perifrac {

namespace {

namespace fs = std::filesystem;

/// Of the file that this code is in, where that is the extension of Python.
std::optional<fs::path> extension_file() {
  Dl_info info{};
  std::error_code error;
  const auto* const here = reinterpret_cast<const void*>(&data_folder);
  if (::dladdr(here, &info) == 0 || fs::path(info.dli_fname).extension() != ".so") return {};
  return fs::canonical(info.dli_fname, error);
}

bool holds_data(const fs::path& share) {
  std::error_code error;
  return fs::is_directory(share / "configs", error);
}

/// PREFIX/share/perifrac of PREFIX/bin/perifrac, PREFIX/libexec/perifrac/SET/perifrac, or an
/// extension anywhere in PREFIX.
std::optional<fs::path> installed_folder() {
  if (const auto extension = extension_file()) {
    for (fs::path folder = extension->parent_path(); folder.has_relative_path();
         folder = folder.parent_path()) {
      if (holds_data(folder / "share" / "perifrac")) return folder / "share" / "perifrac";
    }
    return {};
  }
  std::error_code error;
  const fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  const fs::path sets = folder.parent_path();
  fs::path prefix;
  if (folder.filename() == "bin") prefix = folder.parent_path();
  if (sets.filename() == "perifrac" && sets.parent_path().filename() == "libexec") {
    prefix = sets.parent_path().parent_path();
  }
  const fs::path share = prefix / "share" / "perifrac";
  if (error || prefix.empty() || !holds_data(share)) return {};
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
