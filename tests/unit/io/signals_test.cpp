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

// Each in a process of its own: a signal once received stays received. A forked process leaves by
// _Exit: what was allocated before the fork, OpenMP's threads among it, is the parent's to free.
void run_and_exit(std::initializer_list<int> signals) {
  hold_back_signals();
  if (received_signal() != 0) {
    std::_Exit(1);
  }
  for (const int signal : signals) {
    std::raise(signal);
    received_signal();
  }
  std::_Exit(exit_code_of(received_signal()));
}

TEST(Signals, InterruptAndTerminationAreRemembered) {
  EXPECT_EXIT(run_and_exit({SIGINT}), testing::ExitedWithCode(130), "");
  EXPECT_EXIT(run_and_exit({SIGTERM}), testing::ExitedWithCode(143), "");
}

TEST(Signals, TheFirstThatIsSeenCounts) {
  EXPECT_EXIT(run_and_exit({SIGTERM, SIGINT, SIGINT}), testing::ExitedWithCode(143), "");
}

// METIS does so while it orders an equation.
void raise_where_a_library_handles() {
  hold_back_signals();
  const auto before = std::signal(SIGTERM, [](int) { std::_Exit(3); });
  std::raise(SIGTERM);
  std::signal(SIGTERM, before);
  std::_Exit(exit_code_of(received_signal()));
}

TEST(Signals, WaitBehindTheHandlerOfALibrary) {
  EXPECT_EXIT(raise_where_a_library_handles(), testing::ExitedWithCode(143), "");
}

/// Writes checkpoints while signals rain down, and leaves with their exit code.
void write_under_fire(const std::filesystem::path& folder) {
  hold_back_signals();
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
  std::_Exit(exit_code_of(received_signal()));
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
