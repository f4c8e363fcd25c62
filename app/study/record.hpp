#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "app/study/variants.hpp"

namespace perifrac {

/// How a variant ended.
enum class VariantStatus {
  done,
  diverged,     ///< a numerical failure
  killed,       ///< by a signal that was not ours
  invalid,      ///< its scene was refused
  failed,       ///< anything else, such as a result that could not be written
  over_budget,  ///< stopped at the wall time of one run
  not_run,      ///< the wall time of the study was used up before
};

std::string word(VariantStatus status);

/// What is kept of a variant, in its folder: enough to leave it out when the study goes on.
struct VariantRecord {
  nlohmann::json made_from;  ///< scene, words of the command line, version
  VariantStatus status = VariantStatus::not_run;
  std::string message{};
  double budget = 0.0;                 ///< wall time [s] that a run had
  std::vector<nlohmann::json> runs{};  ///< what each run took
};

/// What a variant's results follow from.
nlohmann::json made_from(const Variant& variant);

/// `key=value` of all that the variant sets, as `--set` takes them.
std::vector<std::string> assignments(const Variant& variant);

/// The record in `folder`, if there is a readable one that was made from the same.
VariantRecord read_record(const std::filesystem::path& folder, const Variant& variant);

/// Written whole or not at all. Throws OutputError.
void write_record(const std::filesystem::path& folder, const VariantRecord& record);

/// Nothing is left to run.
bool is_finished(const VariantRecord& record, const Study& study);

}  // namespace perifrac
