#include "core/io/log.hpp"

#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

#include "core/io/progress.hpp"

namespace perifrac {
namespace {

void log(spdlog::level::level_enum level, std::string_view message) {
  static spdlog::logger logger = [] {
    spdlog::logger made("perifrac", std::make_shared<spdlog::sinks::stderr_sink_st>());
    made.set_pattern("%H:%M:%S %l: %v");
    return made;
  }();
  clear_progress_line();
  logger.log(level, message);
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

}  // namespace perifrac
