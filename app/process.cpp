#include "app/process.hpp"

#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace perifrac {

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

/// What the process finds at its start, freed with this object.
class SpawnSettings {
 public:
  explicit SpawnSettings(const ProcessCommand& command) {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
    if (command.quiet) {
      posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
    }
    if (!command.log.empty()) {
      posix_spawn_file_actions_addopen(&files, STDERR_FILENO, command.log.c_str(),
                                       O_WRONLY | O_CREAT | O_TRUNC, 0644);
    }
    if (command.own_group) {
      posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
      posix_spawnattr_setpgroup(&attributes, 0);
    }
  }
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

}  // namespace

Process::Process(const ProcessCommand& command) : own_group_(command.own_group) {
  std::vector<std::string> words = command.words;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const SpawnSettings settings(command);
  const int error = posix_spawnp(&pid_, arguments[0], &settings.files, &settings.attributes,
                                 arguments.data(), environ);
  if (error != 0) throw std::system_error(error, std::generic_category(), words[0]);
}

Process::~Process() {
  if (end_) return;
  signal(SIGKILL);
  collect(0);
}

std::optional<ProcessEnd> Process::poll() { return collect(WNOHANG); }

ProcessEnd Process::wait() {
  while (!collect(0)) {
  }
  return *end_;
}

void Process::signal(int number) const { ::kill(own_group_ ? -pid_ : pid_, number); }

std::optional<ProcessEnd> Process::collect(int options) {
  int status = 0;
  rusage usage{};
  if (!end_ && wait4(pid_, &status, options, &usage) == pid_) {
    end_ = {.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 0,
            .signal = WIFSIGNALED(status) ? WTERMSIG(status) : 0,
            .cpu_time = seconds(usage.ru_utime) + seconds(usage.ru_stime),
            .peak_memory = 1024.0 * static_cast<double>(usage.ru_maxrss)};
  }
  return end_;
}

}  // namespace perifrac
