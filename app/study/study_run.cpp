#include "app/study/study_run.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <list>
#include <memory>
#include <system_error>
#include <thread>

#include <fmt/format.h>

#include "app/installation/data_folder.hpp"
#include "app/simulation/outside_modules.hpp"
#include "core/base/errors.hpp"
#include "core/io/log.hpp"
#include "core/io/output_folder.hpp"
#include "core/io/process.hpp"
#include "core/io/signals.hpp"

namespace perifrac {

namespace {

using Clock = std::chrono::steady_clock;

constexpr double patience = 10.0;  // [s] between asking a run to stop and making it
constexpr auto look_again = std::chrono::milliseconds(5);

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The last line that says something, without the time of day that the log puts before it.
std::string last_line(const std::filesystem::path& log) {
  std::ifstream file(log);
  std::string last;
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
  }
  const auto mark = last.find(" error: ");
  return mark == std::string::npos ? last : last.substr(mark + 8);
}

/// One run of a variant, under way.
struct Job {
  std::size_t variant;
  std::unique_ptr<Process> process;
  Clock::time_point start = Clock::now();
  double asked_to_stop = 0.0;  ///< when [s] after the start; 0: not yet
  bool over_budget = false;
};

class Queue {
 public:
  Queue(const Study& study, const std::vector<Variant>& variants, const StudyOptions& options)
      : study_(study), variants_(variants), options_(options) {
    program_ = program_file().string();
    for (std::size_t i = 0; i < variants.size(); ++i) take_up(i);
  }

  StudyOutcome run() {
    while (!waiting_.empty() || !jobs_.empty()) {
      outcome_.signal = received_signal();
      if (outcome_.signal != 0) waiting_.clear();
      if (since(begin_) > study_.budget_total) waiting_.clear();
      while (!waiting_.empty() && jobs_.size() < static_cast<std::size_t>(options_.jobs)) {
        start(waiting_.front());
        waiting_.pop_front();
      }
      for (Job& job : jobs_) watch(job);
      std::this_thread::sleep_for(look_again);
      collect();
    }
    return std::move(outcome_);
  }

 private:
  std::filesystem::path folder(std::size_t i) const { return folder_of(options_, variants_[i]); }

  /// Looks up what is on record and queues the rest.
  void take_up(std::size_t i) {
    VariantRecord record = read_record(folder(i), variants_[i]);
    const bool again = options_.fresh || (options_.retry && record.status != VariantStatus::done);
    const bool lost = record.status == VariantStatus::done && !summary_in(folder(i)).is_object();
    if (again || lost ||
        (record.status == VariantStatus::over_budget && !is_finished(record, study_))) {
      record = {.made_from = record.made_from};
    }
    if (!variants_[i].problem.empty()) {
      record.status = VariantStatus::invalid;
      record.message = variants_[i].problem;
      record.runs.clear();
    } else if (is_finished(record, study_)) {
      ++outcome_.kept;
    } else {
      waiting_.push_back(i);
    }
    outcome_.records.push_back(std::move(record));
  }

  std::vector<std::string> command(std::size_t i) const {
    const Variant& variant = variants_[i];
    std::vector<std::string> words = options_.launcher;
    words.insert(words.end(), {program_, "run", variant.scene, "--no-report", "--output",
                               folder(i).string(), "--threads", std::to_string(variant.threads)});
    if (outside_modules_are_allowed()) words.push_back("--allow-modules");
    for (const std::string& assignment : assignments(variant)) {
      words.insert(words.end(), {"--set", assignment});
    }
    return words;
  }

  void start(std::size_t i) {
    // A run left over from a killed study may still hold it; what it left must not pass for ours.
    OutputFolder(folder(i), options_.overwrite).remove_earlier_results();
    try {
      ProcessCommand wanted{
          .words = command(i), .log = folder(i) / "log.txt", .quiet = true, .own_group = true};
      jobs_.push_back({.variant = i, .process = std::make_unique<Process>(wanted)});
    } catch (const std::system_error& error) {
      throw InputError(fmt::format("{}: could not be run ({}); expected a program and its words",
                                   command(i).front(), error.code().message()));
    }
  }

  void watch(Job& job) const {
    const double now = since(job.start);
    const bool late = now > study_.budget_each;
    if (job.asked_to_stop == 0.0 && (late || outcome_.signal != 0)) {
      job.over_budget = late && outcome_.signal == 0;
      job.asked_to_stop = now;
      job.process->signal(SIGTERM);
    } else if (job.asked_to_stop > 0.0 && now > job.asked_to_stop + patience) {
      job.process->signal(SIGKILL);
    }
  }

  void collect() {
    for (auto job = jobs_.begin(); job != jobs_.end();) {
      const auto end = job->process->poll();
      if (end) finish(*job, *end);
      job = end ? jobs_.erase(job) : std::next(job);
    }
  }

  void finish(const Job& job, const ProcessEnd& end) {
    const double elapsed = since(job.start);
    // What we stopped ourselves for a signal is run again another time.
    if (outcome_.signal != 0 && (job.asked_to_stop > 0.0 || end.signal != 0)) return;
    VariantRecord& record = outcome_.records[job.variant];
    const std::filesystem::path place = folder(job.variant);
    record.status = job.over_budget ? VariantStatus::over_budget : status_of(end, place);
    record.message = message_of(record.status, end, place);
    record.budget = study_.budget_each;
    record.runs.push_back(run_of(end, elapsed, place));
    write_record(place, record);
    if (!is_finished(record, study_)) {
      if (outcome_.signal == 0) waiting_.push_front(job.variant);
      return;
    }
    log_info(fmt::format("{} of {}: {}, {} in {:.2f} s{}{}", count_finished(), variants_.size(),
                         variants_[job.variant].name, word(record.status), elapsed,
                         record.message.empty() ? "" : ": ", record.message));
  }

  std::size_t count_finished() const {
    return static_cast<std::size_t>(std::ranges::count_if(
        outcome_.records,
        [&](const VariantRecord& record) { return is_finished(record, study_); }));
  }

  static nlohmann::json summary_in(const std::filesystem::path& folder) {
    std::ifstream file(folder / "summary.json");
    return nlohmann::json::parse(file, nullptr, false);
  }

  /// Launchers hand on the signal that ended a run as 128 and its number.
  static int signal_of(const ProcessEnd& end) {
    return end.signal == 0 && end.exit_code > 128 ? end.exit_code - 128 : end.signal;
  }

  static VariantStatus status_of(const ProcessEnd& end, const std::filesystem::path& folder) {
    if (signal_of(end) != 0) return VariantStatus::killed;
    if (end.exit_code == 0) return VariantStatus::done;
    if (end.exit_code == 2) return VariantStatus::invalid;
    const nlohmann::json summary = summary_in(folder);
    const bool numerical =
        end.exit_code == 1 && summary.is_object() && summary["outcome"] == "failed";
    return numerical ? VariantStatus::diverged : VariantStatus::failed;
  }

  std::string message_of(VariantStatus status, const ProcessEnd& end,
                         const std::filesystem::path& folder) const {
    if (status == VariantStatus::done) return "";
    if (status == VariantStatus::over_budget) {
      return fmt::format("stopped after {:g} s", study_.budget_each);
    }
    if (status == VariantStatus::killed) {
      return fmt::format("by signal {} ({})", signal_of(end), strsignal(signal_of(end)));
    }
    const std::string said = last_line(folder / "log.txt");
    return said.empty() ? fmt::format("exit code {}", end.exit_code) : said;
  }

  /// What a run took; of one without a summary, what the operating system knows.
  static nlohmann::json run_of(const ProcessEnd& end, double elapsed,
                               const std::filesystem::path& folder) {
    nlohmann::json run = {{"elapsed", elapsed}};
    const nlohmann::json summary = summary_in(folder);
    if (!summary.is_object()) {
      run["cpu_time"] = end.cpu_time;
      run["peak_memory"] = end.peak_memory;
      return run;
    }
    for (const char* key : {"wall_time", "output_time", "cpu_time", "peak_memory", "modules",
                            "counts", "machine", "build"}) {
      run[key] = summary[key];
    }
    return run;
  }

  const Study& study_;
  const std::vector<Variant>& variants_;
  const StudyOptions& options_;
  std::string program_;
  std::list<std::size_t> waiting_;
  std::list<Job> jobs_;
  StudyOutcome outcome_;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace

std::filesystem::path folder_of(const StudyOptions& options, const Variant& variant) {
  return options.folder / "variants" / variant.name;
}

StudyOutcome run_variants(const Study& study, const std::vector<Variant>& variants,
                          const StudyOptions& options) {
  return Queue(study, variants, options).run();
}

}  // namespace perifrac
