#include "core/io/process.hpp"

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <system_error>
#include <unistd.h>

namespace perifrac {

namespace {

double seconds(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

void open_as(int descriptor, const char* path, int flags) {
  const int opened = open(path, flags, 0644);
  if (opened >= 0 && opened != descriptor) dup2(opened, descriptor);
}

/// A file of this text in memory, read from its begin; -1: none.
int open_text(const std::string& text) {
  if (text.empty()) return -1;
  const int file = memfd_create("input", MFD_CLOEXEC);
  for (std::size_t done = 0; file >= 0 && done < text.size();) {
    const ssize_t count = write(file, text.data() + done, text.size() - done);
    if (count < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category());
    done += static_cast<std::size_t>(std::max<ssize_t>(count, 0));
  }
  if (file < 0) throw std::system_error(errno, std::generic_category());
  lseek(file, 0, SEEK_SET);
  return file;
}

/// Turns this copy of ours into the program; tells `failure` what hinders it. Nothing in here takes
/// memory or locks: other threads may have been in the middle of that.
[[noreturn]] void become(const ProcessCommand& command, char* const* arguments, int input,
                         pid_t parent, int failure) {
  if (command.own_group) setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  sigset_t none;  // of ours are held back, and would be of the program
  sigemptyset(&none);
  sigprocmask(SIG_SETMASK, &none, nullptr);
  if (getppid() != parent) _exit(1);  // it ended before it could matter
  if (input >= 0) dup2(input, STDIN_FILENO);
  if (command.quiet) open_as(STDOUT_FILENO, "/dev/null", O_WRONLY);
  if (!command.log.empty()) {
    open_as(STDERR_FILENO, command.log.c_str(), O_WRONLY | O_CREAT | O_TRUNC);
  }
  execvp(arguments[0], arguments);
  const int error = errno;
  [[maybe_unused]] const ssize_t told = write(failure, &error, sizeof error);
  _exit(1);
}

}  // namespace

Process::Process(const ProcessCommand& command) : own_group_(command.own_group) {
  std::vector<std::string> words = command.words;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int input = open_text(command.input);
  // Closes by itself where the program takes over: what comes through is why it did not.
  int failure[2];
  if (pipe2(failure, O_CLOEXEC) != 0) throw std::system_error(errno, std::generic_category());
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ == 0) become(command, arguments.data(), input, parent, failure[1]);
  int error = pid_ < 0 ? errno : 0;
  close(failure[1]);
  if (input >= 0) close(input);
  if (pid_ > 0 && read(failure[0], &error, sizeof error) == sizeof error) {
    waitpid(pid_, nullptr, 0);
  }
  close(failure[0]);
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
