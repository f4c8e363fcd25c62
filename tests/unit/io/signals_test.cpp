#include "core/io/signals.hpp"

#include <atomic>
#include <csignal>
#include <cstdlib>
#include <pthread.h>
#include <thread>

#include <gtest/gtest.h>

#include "core/io/checkpoint.hpp"
#include "tests/unit/io/temporary_folder.hpp"

namespace perifrac {
namespace {

// Each in a process of its own: a signal once received stays received.
void run_and_exit(std::initializer_list<int> signals) {
  install_signal_handlers();
  if (received_signal() != 0) {
    std::exit(1);
  }
  for (const int signal : signals) {
    std::raise(signal);
  }
  std::exit(exit_code_of(received_signal()));
}

TEST(Signals, InterruptAndTerminationAreRemembered) {
  EXPECT_EXIT(run_and_exit({SIGINT}), testing::ExitedWithCode(130), "");
  EXPECT_EXIT(run_and_exit({SIGTERM}), testing::ExitedWithCode(143), "");
}

TEST(Signals, TheFirstOneCounts) {
  EXPECT_EXIT(run_and_exit({SIGTERM, SIGINT, SIGINT}), testing::ExitedWithCode(143), "");
}

/// Writes checkpoints while signals rain down, and leaves with their exit code.
void write_under_fire(const std::filesystem::path& folder) {
  install_signal_handlers();
  std::atomic<bool> done = false;
  std::thread storm([&done, target = pthread_self()] {
    while (!done) {
      pthread_kill(target, SIGINT);
    }
  });
  Checkpoint checkpoint{.state = Snapshot({{"u", std::vector<double>(20000, 1.5)}})};
  while (checkpoint.step < 5 || received_signal() == 0) {
    ++checkpoint.step;
    write_checkpoint(folder, checkpoint);
  }
  done = true;
  storm.join();
  std::exit(exit_code_of(received_signal()));
}

TEST(Signals, AStormOfThemSpoilsNoFile) {
  const TemporaryFolder folder;
  EXPECT_EXIT(write_under_fire(folder.path()), testing::ExitedWithCode(130), "");
  EXPECT_EQ(folder.names().size(), 2u);
  for (const std::string& name : folder.names()) {
    EXPECT_NO_THROW(read_checkpoint(folder / name)) << name;
  }
}

}  // namespace
}  // namespace perifrac
