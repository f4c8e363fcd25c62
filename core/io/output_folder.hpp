#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "core/io/file_descriptor.hpp"

namespace perifrac {

/// Which files may be replaced: those of earlier runs, or any that have their names.
enum class Overwrite { own, any };

/// The folder that a run writes into, made if need be, and held against other runs for as long as
/// this object lives. The hold ends with the process however that ends; the empty file DIR/.lock
/// stays.
class OutputFolder {
 public:
  /// Also removes half-written files that a killed run left. Throws InputError where the folder
  /// cannot be made or written into, where another run holds it, or, unless they may be replaced,
  /// where no run was there before and files have the names of results (`more_names` besides);
  /// OutputError where a half-written file cannot be removed.
  explicit OutputFolder(std::filesystem::path folder, Overwrite overwrite = Overwrite::own,
                        std::span<const std::string_view> more_names = {});

  const std::filesystem::path& path() const { return path_; }

  /// For a run that starts anew: removes what an earlier run wrote here, so that old and new
  /// results never mix, and returns how many files that were. Only names that runs write
  /// (history.csv, summary.json, progress.json, report.png, report.html,
  /// checkpoint_<number>.h5, frames/<name>_<number>.hdf, frames/<name>.hdf.series) are touched,
  /// nothing else in the folder. Throws OutputError.
  int remove_earlier_results() const;

 private:
  std::filesystem::path path_;
  FileDescriptor lock_;
};

}  // namespace perifrac
