#include "app/run/progress_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <system_error>
#include <unistd.h>

#include <nlohmann/json.hpp>

#include "app/run/summary.hpp"
#include "core/base/ranks.hpp"
#include "core/io/atomic_file.hpp"

namespace perifrac {

namespace {

using std::chrono::duration;
using std::chrono::steady_clock;

/// When this process began, as the system counts [ticks since it was started]: with the process id
/// it names the process, and no later one that gets the same id.
std::int64_t process_start() {
  std::ifstream stat("/proc/self/stat");
  std::string text;
  std::getline(stat, text);
  // The name, in brackets, may hold anything; the start is the 20th word after it.
  std::size_t at = text.rfind(')');
  for (int word = 0; word < 20 && at != std::string::npos; ++word) at = text.find(' ', at + 1);
  return at == std::string::npos ? 0 : std::strtoll(text.c_str() + at, nullptr, 10);
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

}  // namespace

ProgressFile::ProgressFile(std::filesystem::path folder, double begin, double end, State state)
    : file_(std::move(folder) / "progress.json"),
      begin_(begin),
      end_(end),
      state_(std::move(state)),
      start_(steady_clock::now()),
      next_(start_) {}

ProgressFile::~ProgressFile() {
  std::error_code ignored;
  if (ranks::is_first()) std::filesystem::remove(file_, ignored);
}

void ProgressFile::update(double time, std::int64_t step) {
  const auto now = steady_clock::now();
  if (!ranks::first_says(now >= next_)) return;
  const double wall = duration<double>(now - start_).count();
  time_left_.record(wall, time);
  nlohmann::json state = state_();
  state["outcome"] = "running";
  state["wall_time"] = wall;
  auto& progress = state["progress"];
  progress = {{"begin", begin_},    {"end", end_},         {"time", time},
              {"step", step},       {"process", getpid()}, {"process_start", process_start()},
              {"host", host_name()}};
  if (const auto left = time_left_.until(end_)) progress["left"] = *left;
  if (ranks::is_first()) replace_at_once(file_, json_text(state));
  // However large the scene and slow the disk, a hundredth of the time is enough.
  const auto taken = steady_clock::now() - now;
  next_ = now + std::max<steady_clock::duration>(std::chrono::seconds(1), 100 * taken);
}

}  // namespace perifrac
