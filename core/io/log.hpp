#pragma once

#include <string_view>

namespace perifrac {

/// One line each on standard error, with the time of day; the progress line makes room for it.
/// To be called by one thread at a time.
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

}  // namespace perifrac
