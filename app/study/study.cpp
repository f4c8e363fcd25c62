#include "app/study/study.hpp"

#include <array>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "app/installation/data_folder.hpp"
#include "app/report/drawing.hpp"
#include "app/run/summary.hpp"
#include "app/study/sentences.hpp"
#include "app/study/study_json.hpp"
#include "app/study/study_tables.hpp"
#include "core/io/atomic_file.hpp"
#include "core/io/log.hpp"
#include "core/io/output_folder.hpp"
#include "core/io/signals.hpp"

namespace perifrac {

namespace {

constexpr std::array<std::string_view, 7> results_of_a_study = {
    "study.csv", "study.json", "study.png", "study.svg", "study.html", "table.md", "table.tex"};

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

StudyOptions options_of(const StudyRequest& request) {
  const std::filesystem::path own = "runs" / std::filesystem::path(request.file).stem();
  return {.folder = request.output.empty() ? own : std::filesystem::path(request.output),
          .overwrite = request.overwrite,
          .jobs = request.jobs,
          .launcher = words_of(request.launcher),
          .retry = request.retry,
          .fresh = request.fresh};
}

/// Says at once what will not run, while the study can still be mended.
void warn_of_invalid(const std::vector<Variant>& variants) {
  for (const Variant& variant : variants) {
    if (!variant.problem.empty()) {
      log_warning(fmt::format("{} is invalid: {}", variant.name, variant.problem));
    }
  }
}

int stopped(const StudyOutcome& outcome, const Study& study) {
  std::size_t finished = 0;
  for (const VariantRecord& record : outcome.records) finished += is_finished(record, study);
  log_warning(fmt::format("stopped with {} of {} variants on record; the same command goes on",
                          finished, outcome.records.size()));
  return exit_code_of(outcome.signal);
}

void mark_not_run(std::vector<VariantRecord>& records, const Study& study) {
  for (VariantRecord& record : records) {
    if (record.runs.empty() && record.status == VariantStatus::not_run) {
      record.message = fmt::format("the study's {:g} s were used up", study.budget_total);
    }
  }
}

}  // namespace

int run_study(const StudyRequest& request) {
  const Study study = read_study(request.file);
  const Matrix matrix = expand(study);
  const StudyOptions options = options_of(request);
  hold_back_signals();
  const OutputFolder folder(options.folder, options.overwrite, results_of_a_study);
  warn_of_invalid(matrix.variants);
  StudyOutcome outcome = run_variants(study, matrix.variants, options);
  if (outcome.signal != 0) return stopped(outcome, study);
  if (outcome.kept > 0) log_info(fmt::format("{} kept from before", outcome.kept));
  mark_not_run(outcome.records, study);

  const StudyResults results =
      conclude(study, evaluate(study, matrix.variants, outcome.records, options));
  const std::vector<std::string> said = sentences(study, results, matrix.left_out);
  const nlohmann::json json = study_json(study, results, options, matrix.left_out, said);
  write_atomically(options.folder / "study.csv", csv_table(study, results));
  write_atomically(options.folder / "study.json", json_text(json));
  write_atomically(options.folder / "table.md", markdown_table(study, results));
  write_atomically(options.folder / "table.tex", latex_table(study, results));
  if (request.json) {
    fmt::print("{}", json_text(json));
  } else {
    fmt::print("{}\n\n{}\n", study.title, markdown_table(study, results));
    for (const std::string& sentence : said) fmt::print("{}\n", sentence);
  }
  std::fflush(stdout);
  if (request.report && draw(data_folder() / "app/study/drawing/study.py",
                             {options.folder.string()}, request.json) != 0) {
    log_warning("no picture was made of the study; the same command tries again");
  }
  return 0;
}

}  // namespace perifrac
