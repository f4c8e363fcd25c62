#include "app/report/watch.hpp"

#include <csignal>
#include <cstdlib>
#include <system_error>
#include <vector>

#include "app/installation/data_folder.hpp"
#include "core/io/log.hpp"

namespace perifrac {

namespace {

std::vector<std::string> command(const std::filesystem::path& folder) {
  const char* const chosen = std::getenv("PERIFRAC_PYTHON");
  return {chosen != nullptr ? chosen : "/usr/bin/python3", "-B",
          data_folder() / "app/report/watch.py", folder.string()};
}

}  // namespace

int watch(const WatchRequest& request) {
  ProcessCommand server{.words = command(request.folder)};
  server.words.push_back("--port");
  server.words.push_back(std::to_string(request.port));
  try {
    const ProcessEnd end = Process(server).wait();
    return end.signal == 0 ? end.exit_code : 0;
  } catch (const std::system_error&) {
    log_error("/usr/bin/python3 could not be run; install the Debian package python3");
    return 1;
  }
}

Watcher::Watcher(const std::filesystem::path& folder) {
  // A group of its own: a key that stops the run must not take the page from whoever looks on.
  ProcessCommand server{.words = command(folder), .own_group = true};
  server.words.push_back("--with-run");
  try {
    server_.emplace(server);
  } catch (const std::system_error&) {
    log_warning("nobody can watch: /usr/bin/python3 could not be run");
  }
}

Watcher::~Watcher() {
  if (!server_) return;
  server_->signal(SIGTERM);
  server_->wait();
}

}  // namespace perifrac
