#include "app/report/drawing.hpp"

#include <cstdlib>
#include <system_error>

#include <fmt/format.h>

#include "core/io/log.hpp"
#include "core/io/process.hpp"

namespace perifrac {

int draw(const std::string& script, const std::vector<std::string>& paths, bool quiet,
         const std::string& input) {
  // Debian's own Python: another one first on the path may lack matplotlib and h5py.
  const char* const chosen = std::getenv("PERIFRAC_PYTHON");
  std::vector<std::string> words{chosen != nullptr ? chosen : "/usr/bin/python3", "-B", script};
  words.insert(words.end(), paths.begin(), paths.end());
  try {
    const ProcessEnd end = Process({.words = words, .input = input, .quiet = quiet}).wait();
    if (end.signal == 0) return end.exit_code;
  } catch (const std::system_error&) {
  }
  log_warning(fmt::format("no report: {} could not be run", words.front()));
  return 1;
}

}  // namespace perifrac
