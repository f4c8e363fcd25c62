#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace perifrac {

/// One line each on standard error, with the time of day; the progress line makes room for it.
/// To be called by one thread at a time.
void log_info(std::string_view message);
void log_warning(std::string_view message);
void log_error(std::string_view message);

/// The warnings so far, for what a run leaves; of very many the first.
const std::vector<std::string>& logged_warnings();
/// Another run begins in this process.
void forget_logged_warnings();

}  // namespace perifrac
