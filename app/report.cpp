#include "app/report.hpp"

#include <array>
#include <fcntl.h>
#include <spawn.h>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include <fmt/format.h>

#include "core/io/log.hpp"

namespace perifrac {

int make_report(const std::filesystem::path& folder, bool quiet) {
  // Debian's own Python: another one first on the path may lack matplotlib and h5py.
  std::string python = "/usr/bin/python3";
  std::string script = PERIFRAC_REPORT_SCRIPT;
  std::string directory = folder.string();
  const std::array<char*, 4> arguments = {python.data(), script.data(), directory.data(), nullptr};
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (quiet) {
    posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  }
  pid_t child = 0;
  const int failed =
      posix_spawn(&child, python.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  int status = 0;
  if (failed != 0 || waitpid(child, &status, 0) != child || !WIFEXITED(status)) {
    log_warning(fmt::format("no report: {} could not be run", python));
    return 1;
  }
  return WEXITSTATUS(status);
}

}  // namespace perifrac
