#include "app/study/record.hpp"

#include <array>
#include <cmath>
#include <fstream>
#include <sstream>

#include "app/run/summary.hpp"
#include "app/run/version.hpp"
#include "core/io/atomic_file.hpp"

namespace perifrac {

namespace {

constexpr std::array status_words = {"done",   "diverged",    "killed", "invalid",
                                     "failed", "over budget", "not run"};
constexpr const char* file_name = "record.json";

std::string content(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

}  // namespace

std::string word(VariantStatus status) { return status_words[static_cast<std::size_t>(status)]; }

std::vector<std::string> assignments(const Variant& variant) {
  std::vector<std::string> result;
  for (const Override& override : variant.overrides) result.push_back(override.assignment());
  return result;
}

nlohmann::json made_from(const Variant& variant) {
  return {{"scene", content(variant.scene)},
          {"set", assignments(variant)},
          {"threads", variant.threads},
          {"version", version}};
}

VariantRecord read_record(const std::filesystem::path& folder, const Variant& variant) {
  VariantRecord record{.made_from = made_from(variant)};
  const nlohmann::json kept = nlohmann::json::parse(content(folder / file_name), nullptr, false);
  if (kept.is_discarded() || !kept.is_object() ||
      kept.value("made_from", nlohmann::json()) != record.made_from) {
    return record;
  }
  for (std::size_t i = 0; i < status_words.size(); ++i) {
    if (kept.at("status") == status_words[i]) record.status = static_cast<VariantStatus>(i);
  }
  record.message = kept.at("message");
  record.budget = kept.at("budget").is_null() ? INFINITY : kept.at("budget").get<double>();
  record.runs = kept.at("runs").get<std::vector<nlohmann::json>>();
  return record;
}

void write_record(const std::filesystem::path& folder, const VariantRecord& record) {
  // JSON has no infinity: a budget without bounds is written as null.
  const nlohmann::json kept = {{"made_from", record.made_from},
                               {"status", word(record.status)},
                               {"message", record.message},
                               {"budget", record.budget},
                               {"runs", record.runs}};
  write_atomically(folder / file_name, json_text(kept));
}

bool is_finished(const VariantRecord& record, const Study& study) {
  switch (record.status) {
    case VariantStatus::not_run:
      return false;
    case VariantStatus::over_budget:
      return study.budget_each <= record.budget;
    case VariantStatus::done:
      return record.runs.size() >= static_cast<std::size_t>(study.repetitions) ||
             record.runs.front().at("elapsed").get<double>() > study.repeat_up_to;
    default:
      return true;
  }
}

}  // namespace perifrac
