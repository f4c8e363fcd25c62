#include "core/io/output_folder.hpp"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <string>
#include <string_view>
#include <sys/file.h>
#include <unistd.h>
#include <vector>

#include <fmt/format.h>

#include "core/base/errors.hpp"
#include "core/io/atomic_file.hpp"

namespace perifrac {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& folder, const std::string& reason) {
  throw InputError(fmt::format(
      "{}: cannot be used as the output folder: {}; expected a folder that this run may write "
      "into; give another one with --output",
      folder.string(), reason));
}

constexpr const char* lock_name = ".lock";

/// Makes the folder and returns it, for use before the lock in it is opened.
std::filesystem::path make_folder(std::filesystem::path folder) {
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) {
    refuse(folder, error.message());
  }
  if (::access(folder.c_str(), W_OK | X_OK) != 0) {
    refuse(folder, std::strerror(errno));
  }
  return folder;
}

/// STEM where a name reads STEM_<digits><ending>, else nothing.
std::string_view stem_of_numbered(std::string_view name, std::string_view ending) {
  if (!name.ends_with(ending)) {
    return {};
  }
  name.remove_suffix(ending.size());
  const auto last = name.find_last_not_of("0123456789");
  const bool numbered =
      last != std::string_view::npos && name[last] == '_' && last + 1 < name.size();
  return numbered ? name.substr(0, last) : std::string_view{};
}

bool is_result(std::string_view name) {
  return name == "history.csv" || name == "summary.json" || name == "progress.json" ||
         name == "report.png" || name == "report.html" ||
         stem_of_numbered(name, ".h5") == "checkpoint";
}

bool is_frame(std::string_view name) {
  return !stem_of_numbered(name, ".hdf").empty() || name.ends_with(".hdf.series");
}

/// Files in `folder` whose names, less the suffix of a temporary, `is_ours` knows.
std::vector<std::filesystem::path> files_of_runs(const std::filesystem::path& folder,
                                                 bool (*is_ours)(std::string_view),
                                                 bool unfinished_only) {
  std::vector<std::filesystem::path> found;
  std::error_code missing;
  for (const auto& entry : std::filesystem::directory_iterator(folder, missing)) {
    const std::string full_name = entry.path().filename();
    std::string_view name = full_name;
    const bool unfinished = name.ends_with(temporary_suffix);
    if (unfinished) {
      name.remove_suffix(temporary_suffix.size());
    }
    const bool is_wanted = (unfinished || !unfinished_only) && is_ours(name);
    if (is_wanted && !entry.is_directory(missing)) {  // a loop of links is none
      found.push_back(entry.path());
    }
  }
  return found;
}

std::vector<std::filesystem::path> all_files_of_runs(const std::filesystem::path& folder,
                                                     bool unfinished_only) {
  auto files = files_of_runs(folder, is_result, unfinished_only);
  const auto frames = files_of_runs(folder / "frames", is_frame, unfinished_only);
  files.insert(files.end(), frames.begin(), frames.end());
  return files;
}

int remove_files_of_runs(const std::filesystem::path& folder, bool unfinished_only) {
  const auto files = all_files_of_runs(folder, unfinished_only);
  for (const auto& file : files) {
    std::error_code error;
    std::filesystem::remove(file, error);
    if (error) {
      throw OutputError(file.string(),
                        "it is in the way and cannot be removed: " + error.message());
    }
  }
  return static_cast<int>(files.size());
}

/// Every run leaves a lock. Without one, files of the names that we write are somebody else's.
void refuse_foreign_files(const std::filesystem::path& folder, Overwrite overwrite,
                          std::span<const std::string_view> more_names) {
  std::error_code missing;
  if (overwrite == Overwrite::any || std::filesystem::exists(folder / lock_name, missing)) return;
  std::vector<std::filesystem::path> files = all_files_of_runs(folder, false);
  for (const std::string_view name : more_names) {
    if (std::filesystem::exists(folder / name, missing)) files.push_back(folder / name);
  }
  if (files.empty()) return;
  std::ranges::sort(files);
  throw InputError(fmt::format(
      "{}: is not of a run, and would be replaced; expected a folder without it; give another one "
      "with --output, or --overwrite",
      files.front().string()));
}

}  // namespace

OutputFolder::OutputFolder(std::filesystem::path folder, Overwrite overwrite,
                           std::span<const std::string_view> more_names)
    : path_(make_folder(std::move(folder))),
      lock_((refuse_foreign_files(path_, overwrite, more_names), path_ / lock_name),
            O_RDWR | O_CREAT) {
  if (!lock_.is_open()) {
    refuse(path_, std::strerror(errno));
  }
  if (::flock(lock_.get(), LOCK_EX | LOCK_NB) != 0) {
    refuse(path_, errno == EWOULDBLOCK ? "another run is writing into it" : std::strerror(errno));
  }
  remove_files_of_runs(path_, true);
}

int OutputFolder::remove_earlier_results() const { return remove_files_of_runs(path_, false); }

}  // namespace perifrac
