#include "core/io/log.hpp"

#include <cstdlib>
#include <string>
#include <unistd.h>

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "core/io/progress.hpp"

namespace perifrac {
namespace {

/// On a terminal that has not been told to be without (https://no-color.org).
bool is_coloured() {
  const char* const none = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (none == nullptr || *none == '\0');
}

/// `warning`, in yellow, as a terminal has it.
std::string word(spdlog::level::level_enum level) {
  const auto name = spdlog::level::to_string_view(level);
  std::string text(name.data(), name.size());
  if (!is_coloured()) return text;
  const char* const colour = level == spdlog::level::err    ? "\x1b[1;31m"
                             : level == spdlog::level::warn ? "\x1b[33m"
                                                            : "\x1b[2m";
  return colour + text + "\x1b[0m";
}

void log(spdlog::level::level_enum level, std::string_view message) {
  static spdlog::logger logger = [] {
    spdlog::logger made("perifrac", std::make_shared<spdlog::sinks::stderr_sink_st>());
    made.set_pattern("%H:%M:%S %v");
    return made;
  }();
  clear_progress_line();
  std::string line = word(level) + ": ";
  line += message;
  logger.log(level, spdlog::string_view_t(line.data(), line.size()));
}

std::vector<std::string> warnings;

}  // namespace

void log_info(std::string_view message) { log(spdlog::level::info, message); }
void log_warning(std::string_view message) {
  constexpr std::size_t most_kept = 100;
  if (warnings.size() < most_kept) warnings.emplace_back(message);
  log(spdlog::level::warn, message);
}
void log_error(std::string_view message) { log(spdlog::level::err, message); }

const std::vector<std::string>& logged_warnings() { return warnings; }

void forget_logged_warnings() { warnings.clear(); }

}  // namespace perifrac
