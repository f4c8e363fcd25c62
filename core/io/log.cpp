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

}  // namespace

void log_info(std::string_view message) { log(spdlog::level::info, message); }
void log_warning(std::string_view message) { log(spdlog::level::warn, message); }
void log_error(std::string_view message) { log(spdlog::level::err, message); }

}  // namespace perifrac
