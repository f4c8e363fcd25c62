#include "core/io/progress.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fcntl.h>
#include <pty.h>
#include <string>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/io/log.hpp"

namespace perifrac {
namespace {

using testing::MatchesRegex;

/// What `act` writes to a standard error that is `there` (closed here); read from `here`.
template <class Action>
std::string stderr_of(int here, int there, const Action& act) {
  const int before = dup(STDERR_FILENO);
  dup2(there, STDERR_FILENO);
  close(there);
  act();
  dup2(before, STDERR_FILENO);
  close(before);
  std::string text;
  char block[4096];
  fcntl(here, F_SETFL, O_NONBLOCK);
  for (ssize_t count = 0; (count = read(here, block, sizeof block)) > 0;) {
    text.append(block, static_cast<std::size_t>(count));
  }
  close(here);
  return text;
}

template <class Action>
std::string on_terminal(const Action& act, unsigned short width = 120) {
  int here = -1;
  int there = -1;
  const winsize size{.ws_row = 24, .ws_col = width, .ws_xpixel = 0, .ws_ypixel = 0};
  openpty(&here, &there, nullptr, nullptr, &size);
  return stderr_of(here, there, act);
}

template <class Action>
std::string on_pipe(const Action& act) {
  int ends[2];
  EXPECT_EQ(pipe(ends), 0);
  return stderr_of(ends[0], ends[1], act);
}

const std::string erase_line = "\r\x1b[K";

TEST(Progress, IsQuietOnAPipe) {
  EXPECT_EQ(on_pipe([] {
              Progress progress(0.0, 100.0);
              progress.update(42.0, 7);
            }),
            "");
}

TEST(Progress, ShowsALineOnATerminalAndTakesItAway) {
  EXPECT_EQ(on_terminal([] {
              Progress progress(0.0, 100.0);
              progress.update(42.0, 7);
            }),
            "\r 42 %   t = 42 s of 100 s   7 windows\x1b[K" + erase_line);
}

TEST(Progress, FitsTheTerminal) {
  EXPECT_EQ(on_terminal(
                [] {
                  Progress progress(0.0, 100.0);
                  progress.update(42.0, 7);
                },
                10),
            "\r 42 %   t\x1b[K" + erase_line);
}

TEST(Progress, IsShownAtMostFiveTimesASecond) {
  const auto start = std::chrono::steady_clock::now();
  const std::string text = on_terminal([] {
    Progress progress(0.0, 1e5);
    for (int step = 0; step < 100000; ++step) {
      progress.update(step, step);
    }
  });
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  EXPECT_LE(static_cast<double>(std::count(text.begin(), text.end(), '%')),
            1.0 + wall.count() / 0.2);
}

TEST(Log, MakesTheProgressLineGoBeforeItWrites) {
  unsetenv("NO_COLOR");
  const std::string text = on_terminal([] {
    Progress progress(0.0, 100.0);
    progress.update(42.0, 7);
    log_warning("the split may diverge");
  });
  const auto erased = text.find(erase_line);
  ASSERT_NE(erased, std::string::npos);
  EXPECT_THAT(text.substr(erased + erase_line.size()),
              MatchesRegex("[0-9:]+ \x1b\\[33mwarning\x1b\\[0m: the split may diverge\r\n"));
}

TEST(Log, HasNoColoursWhereNoneAreWanted) {
  setenv("NO_COLOR", "1", 1);
  EXPECT_THAT(on_terminal([] { log_error("c"); }), MatchesRegex("[0-9:]+ error: c\r\n"));
  unsetenv("NO_COLOR");
}

TEST(Log, WritesPlainLinesToAPipe) {
  EXPECT_THAT(on_pipe([] {
                log_info("a {} b");  // braces are text
                log_error("c");
              }),
              MatchesRegex("[0-9]+:[0-9]+:[0-9]+ info: a \\{\\} b\n[0-9:]+ error: c\n"));
}

TEST(TimeLeft, KnowsNothingBeforeTheSecondRecord) {
  TimeLeft left;
  EXPECT_FALSE(left.until(10.0));
  left.record(0.0, 0.0);
  EXPECT_FALSE(left.until(10.0));
  left.record(0.0, 1.0);  // no wall time has gone by
  EXPECT_FALSE(left.until(10.0));
}

TEST(TimeLeft, IsExactAtConstantSpeed) {
  TimeLeft left;
  for (const double wall : {0.0, 0.2, 0.5, 3.0, 20.0}) {
    left.record(wall, 4.0 * wall);
  }
  EXPECT_NEAR(*left.until(100.0), 5.0, 1e-12);
}

TEST(TimeLeft, ForgetsTheSpeedOfLongAgo) {
  TimeLeft left;
  double simulated = 0.0;
  for (int second = 0; second <= 200; ++second) {
    left.record(second, simulated);
    simulated += second < 100 ? 1e-3 : 1.0;
  }
  // The last 100 s ran at 1; the slow start weighs exp(-10).
  EXPECT_NEAR(*left.until(simulated - 1.0 + 50.0), 50.0, 50.0 * std::exp(-9.9));
}

}  // namespace
}  // namespace perifrac
