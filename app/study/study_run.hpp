#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/study/record.hpp"
#include "core/io/output_folder.hpp"

namespace perifrac {

struct StudyOptions {
  std::filesystem::path folder;
  Overwrite overwrite = Overwrite::own;
  int jobs = 1;                         ///< variants at a time
  std::vector<std::string> launcher{};  ///< words before the command of every run
  bool retry = false;                   ///< run again what did not end well
  bool fresh = false;                   ///< run everything again
};

/// The folder of a variant.
std::filesystem::path folder_of(const StudyOptions& options, const Variant& variant);

struct StudyOutcome {
  std::vector<VariantRecord> records;  ///< one a variant
  int kept = 0;                        ///< of them from before
  int signal = 0;                      ///< that stopped the study; 0: none
};

/// Runs each variant as a process of its own, repetitions one after another, and keeps a record of
/// each as soon as it ends. What is on record already is not run again. A signal stops the runs,
/// keeps the records and ends it. Throws InputError where nothing can be started, OutputError.
StudyOutcome run_variants(const Study& study, const std::vector<Variant>& variants,
                          const StudyOptions& options);

}  // namespace perifrac
